% Axioms that 'seewhy learn' found in the record of 40 runs.

%% if a person works in a place, then usually the person is in the place
% learned from 90 observations, 81.1 % of them rightly
loc(P, L) if work_place(P, L), not -loc(P, L).

