% The cards of the game SET: three of them are a set when each of their four features is all alike
% or all different.

#sort picture.
#sort card = things.
#sort count = {one, two, three}.
#sort hue = {green, purple, red}.
#sort fill = {empty, solid, striped}.
#sort form = {diamond, oval, squiggle}.

#static number(card, count).
#static colour(card, hue).
#static shading(card, fill).
#static shape(card, form).

#static left(card, card).
#static right(card, card).
#static above(card, card).
#static below(card, card).

#static numbers_fit(card, card, card).
#static colours_fit(card, card, card).
#static shadings_fit(card, card, card).
#static shapes_fit(card, card, card).
#static set(card, card, card).

%% three cards are a set when each feature is all alike or all different
set(A, B, C) if numbers_fit(A, B, C), colours_fit(A, B, C), shadings_fit(A, B, C), shapes_fit(A, B, C).

%% numbers fit that are all alike
numbers_fit(A, B, C) if number(A, N), number(B, N), number(C, N), A != B, A != C, B != C.
%% numbers fit that are all different
numbers_fit(A, B, C) if number(A, K), number(B, M), number(C, N), K != M, K != N, M != N.

%% colours fit that are all alike
colours_fit(A, B, C) if colour(A, N), colour(B, N), colour(C, N), A != B, A != C, B != C.
%% colours fit that are all different
colours_fit(A, B, C) if colour(A, K), colour(B, M), colour(C, N), K != M, K != N, M != N.

%% shadings fit that are all alike
shadings_fit(A, B, C) if shading(A, N), shading(B, N), shading(C, N), A != B, A != C, B != C.
%% shadings fit that are all different
shadings_fit(A, B, C) if shading(A, K), shading(B, M), shading(C, N), K != M, K != N, M != N.

%% shapes fit that are all alike
shapes_fit(A, B, C) if shape(A, N), shape(B, N), shape(C, N), A != B, A != C, B != C.
%% shapes fit that are all different
shapes_fit(A, B, C) if shape(A, K), shape(B, M), shape(C, N), K != M, K != N, M != N.
