#sort structure.
#sort block = things.
#sort hue = {red, blue, yellow, green, orange, purple, white, teal, pink}.
#sort extent = {narrow, wide}.

#static colour(block, hue).
#static width(block, extent).

#static on(block, block).
#static under(block, block).
#static beyond(block, block).

#static above(block, block).
#static beneath(block, block).
#static lies_on_something(block).
#static carries_something(block).
#static clear(block).
#static displaced(block).
#static moved(block).
#static falls(block).
#static stays(block).
#static falls_without(block, block).
#static stable(structure).

%% what lies beyond the edge of a block lies on that block, if on any
-on(X, Z) if beyond(X, Y), block(Z), Z != Y.
%% no block lies on two
-on(X, Z) if on(X, Y), block(Z), Z != Y.
%% no block carries two
-on(Z, Y) if on(X, Y), block(Z), Z != X.
%% no block lies on what lies on it
-on(Y, X) if on(X, Y).

%% what is on a block is above it
above(X, Y) if on(X, Y).
%% what is on a block is above all that this is above
above(X, Z) if on(X, Y), above(Y, Z).
%% what a block is above is beneath it
beneath(Y, X) if above(X, Y).
%% what is on a block lies on something
lies_on_something(X) if on(X, Y).

%% what another block is on carries something
carries_something(X) if on(Y, X).
%% a block is clear when nothing is on it
clear(X) if block(X), not carries_something(X).

%% a block is displaced when its middle lies beyond the edge of the one below
displaced(X) if beyond(X, Y).
%% what is displaced would have to be moved
moved(X) if displaced(X).

%% a block that is displaced falls
falls(X) if displaced(X).
%% what is on a block that falls, falls with it
falls(X) if on(X, Y), falls(Y).
%% the lowest block stays
stays(X) if block(X), not lies_on_something(X).
%% a block that is balanced stays on a block that stays
stays(X) if on(X, Y), stays(Y), not displaced(X).
%% what is above a block falls when that is taken away
falls_without(X, Y) if above(X, Y).

%% a structure in which a block falls is unstable
-stable(S) if structure(S), falls(X).
%% a structure in which every block stays is stable
stable(S) if structure(S), #count { X : block(X), not stays(X) } = 0.
