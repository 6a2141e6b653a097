#sort picture.
#sort thing = things.
#sort extent = {small, large}.
#sort hue = {gray, red, blue, green, brown, purple, cyan, yellow}.
#sort stuff = {rubber, metal}.
#sort form = {cube, sphere, cylinder}.

#static size(thing, extent).
#static colour(thing, hue).
#static material(thing, stuff).
#static shape(thing, form).

#static left(thing, thing).
#static right(thing, thing).
#static in_front(thing, thing).
#static behind(thing, thing).
#static on(thing, thing).
#static under(thing, thing).

#static above(thing, thing).
#static beneath(thing, thing).
#static stands_on_something(thing).
#static carries_something(thing).
#static clear(thing).
#static falls(thing).
#static stable(thing).
#static falls_without(thing, thing).

%% what is on a thing is above it
above(X, Y) if on(X, Y).
%% what is on a thing is above all that this is above
above(X, Z) if on(X, Y), above(Y, Z).
%% what a thing is above is beneath it
beneath(Y, X) if above(X, Y).
%% what is on a thing stands on something
stands_on_something(X) if on(X, Y).

%% what another thing is on carries something
carries_something(X) if on(Y, X).
%% a thing is clear when nothing is on it
clear(X) if thing(X), not carries_something(X).

%% nothing stays on a ball
falls(X) if on(X, Y), shape(Y, sphere).
%% what is on something that falls, falls with it
falls(X) if on(X, Y), falls(Y).
%% a thing on the table stays
stable(X) if thing(X), not stands_on_something(X).
%% a thing stays on what is no ball and stays itself
stable(X) if on(X, Y), stable(Y), -shape(Y, sphere).
%% what is above a thing falls when that is taken away
falls_without(X, Y) if above(X, Y).

%% a thing is on one thing only
-on(X, Z) if on(X, Y), thing(Z), Y != Z.
%% nothing is on what stands above it
-on(X, Y) if above(Y, X).
