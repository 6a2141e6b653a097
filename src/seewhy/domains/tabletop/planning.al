% What a hand can do with the things on a table. What is seen of things, and what follows from what
% stands on what, is in knowledge.al; here it changes.

#sort robot = {hand}.
#sort number = 1..10.

#fluent basic on(thing, thing).
#fluent basic holding(robot, thing).
#fluent defined under(thing, thing).
#fluent defined on_table(thing).
#fluent defined base(thing, thing).
#fluent defined height(thing, number).
#fluent defined tower_of(number).
#fluent defined stacked.

#action pick_up(robot, thing).
#action put_on(robot, thing, thing).
#action put_down(robot, thing).
#action exogenous drop(thing).
#action exogenous topple(thing).
#action exogenous fall_onto(thing, thing).

% What actions do

%% who picks up a thing holds it
pick_up(R, X) causes holding(R, X).
%% a thing that is put on another is on it
put_on(R, X, Y) causes on(X, Y).
%% a thing that is put on the table is not held
put_down(R, X) causes -holding(R, X).
%% a thing that drops from the hand falls on the table
drop(X) causes -holding(hand, X).
%% a thing that topples falls on the table
topple(X) causes -on(X, Y).
%% what is above a thing that topples falls with it
topple(X) causes -on(Z, Y) if above(Z, X).
%% a thing that falls onto another comes to lie on it
fall_onto(X, Y) causes on(X, Y).

% What is so in every state

%% nothing is on itself
-on(X, X) if thing(X).
%% a thing that is held is on nothing
-on(X, Y) if holding(R, X), thing(Y).
%% nothing is on a thing that is held
-on(Y, X) if holding(R, X), thing(Y).
%% a thing that is on another is not held
-holding(R, X) if on(X, Y), robot(R).
%% the hand holds one thing
-holding(R, Y) if holding(R, X), thing(Y), X != Y.

% What is impossible

%% the hand holds one thing at a time
impossible pick_up(R, X) if holding(R, Y).
%% a thing that carries another is not picked up
impossible pick_up(R, X) if carries_something(X).
%% only a thing that is held can be put on another
impossible put_on(R, X, Y) if not holding(R, X).
%% there is no room on a thing that carries another
impossible put_on(R, X, Y) if carries_something(Y).
%% a thing is not put on itself
impossible put_on(R, X, X) if thing(X).
%% a thing is not put on a ball, on which nothing stays
impossible put_on(R, X, Y) if shape(Y, sphere).
%% a thing is not put on what would fall
impossible put_on(R, X, Y) if falls(Y).
%% only a thing that is held can be put on the table
impossible put_down(R, X) if not holding(R, X).
impossible drop(X) if not holding(hand, X).
impossible topple(X) if not stands_on_something(X).
impossible fall_onto(X, Y) if on_table(X).
impossible fall_onto(X, Y) if on(X, Y).
impossible fall_onto(X, X) if thing(X).
impossible fall_onto(X, Y) if above(Y, X).

% What is usual at first

%% things are on the table
default -on(X, Y).
%% the hand is empty
default -holding(R, X).

% What follows

%% a thing is under what is on it
under(Y, X) if on(X, Y).
%% what is on nothing and not held is on the table
on_table(X) if thing(X), not stands_on_something(X), not holding(hand, X).
base(X, X) if on_table(X).
base(X, Z) if on(X, Y), base(Y, Z).
%% a thing on the table is one thing high
height(X, 1) if on_table(X).
%% a thing is one higher than the thing that it is on
height(X, N + 1) if on(X, Y), height(Y, N), N < 10.
%% a tower is as high as its topmost thing
tower_of(N) if height(X, N), clear(X).
%% things are stacked where one is on another
stacked if on(X, Y).
