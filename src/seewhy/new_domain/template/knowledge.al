% The signature: sorts, and statics over them. "apple" is the picture at hand.
#sort apple.
#sort hue = {red, green, brown}.
#static colour(apple, hue).
#static spotted(apple).
#static good(apple).

% The axioms. The line above each (%%) is its sentence and appears in answers. They need not cover
% everything: what they leave open is learned from your pictures.

%% a brown apple is spoilt
-good(S) if colour(S, brown).

%% a red apple with a clear skin is good
good(S) if colour(S, red), not spotted(S).
