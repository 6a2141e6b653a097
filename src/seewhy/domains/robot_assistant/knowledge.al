% What a robot knows that brings messages to people in an office building.

#sort view.
#sort robot = {rob1}.
#sort person = {bob, john, sarah, sally}.
#sort agent = robot + person.
#sort object = {desk, chair, computer, cup, small_box, large_box, sofa, books, plant}.
#sort entity = agent + object.
#sort place = {bobs_office, johns_office, sarahs_office, sallys_office, kitchen, library, bathroom}.
#sort message = {m1, m2}.
#sort status = {undelivered, delivered}.

#static next_to(place, place).
#static connected(place, place).
#static work_place(person, place).
#static usual(object, place).
#static printer(place).

% What a picture of a room shows
#static desk(view).
#static chair(view).
#static computer(view).
#static cup(view).
#static small_box(view).
#static large_box(view).
#static sofa(view).
#static books(view).
#static plant(view).
#static bob(view).
#static john(view).
#static sarah(view).
#static sally(view).
#static occupied(view).

#fluent basic loc(agent, place).
#fluent basic present(object, place).
#fluent basic closed(place).
#fluent basic has(robot, message).
#fluent basic message_status(message, person, status).
#fluent defined unusual(object, place).
#fluent defined cluttered(place).

#action move(robot, place).
#action deliver(robot, message, person).
#action print(robot, message).
#action exogenous walk(person, place).
#action exogenous shut(place).
#action exogenous unlock(place).
#action exogenous lose(message).

% The map

next_to(kitchen, bathroom).
next_to(kitchen, library).
next_to(bobs_office, library).
next_to(johns_office, library).
next_to(sarahs_office, kitchen).
next_to(sallys_office, kitchen).
connected(A, B) if next_to(A, B).
connected(B, A) if next_to(A, B).

work_place(bob, bobs_office).
work_place(john, johns_office).
work_place(sarah, sarahs_office).
work_place(sally, sallys_office).

printer(library).

% What actions do

%% who moves to a place is there
move(R, L) causes loc(R, L).
%% who delivers a message to a person has delivered it
deliver(R, M, P) causes message_status(M, P, delivered).
%% who prints a message has it
print(R, M) causes has(R, M).
%% who walks to a place is there
walk(P, L) causes loc(P, L).
shut(L) causes closed(L).
unlock(L) causes -closed(L).
%% a message that is lost is no longer with the robot
lose(M) causes -has(R, M).

% What is so in every state

%% people are in their own office unless they are elsewhere
loc(P, L) if work_place(P, L), not -loc(P, L).
%% nobody is at two places
-loc(T, L2) if loc(T, L1), L1 != L2.
%% a message is delivered or is not
-message_status(M, P, S2) if message_status(M, P, S1), S1 != S2.

% What is impossible

%% a message is delivered to somebody who is where the robot is
impossible deliver(R, M, P) if loc(R, L1), loc(P, L2), L1 != L2.
%% a message is delivered to somebody who is known to be where the robot is
impossible deliver(R, M, P) if loc(R, L), not loc(P, L).
%% a message that the robot does not have cannot be delivered
impossible deliver(R, M, P) if not has(R, M).
%% the robot does not move to where it is
impossible move(R, L) if loc(R, L).
%% the robot moves to places next to its own
impossible move(R, L) if loc(R, L1), L1 != L, not connected(L1, L).
%% nobody enters a place that is closed
impossible move(R, L) if closed(L).
%% messages are printed where a printer is
impossible print(R, M) if loc(R, L), not printer(L).
%% a message that the robot has needs no printing
impossible print(R, M) if has(R, M).
impossible walk(P, L) if loc(P, L).
impossible walk(P, L) if closed(L).
impossible shut(L) if closed(L).
impossible unlock(L) if -closed(L).
impossible lose(M) if not has(rob1, M).

% What is usual at first

%% doors are open
default -closed(L).
%% messages are not yet delivered
default message_status(M, P, undelivered).
%% the robot has the messages that it is given
default has(R, M).
%% an office has a desk, a chair and a computer
default present(O, L) if usual(O, L), work_place(_, L).

usual(desk, L) if work_place(_, L).
usual(chair, L) if work_place(_, L).
usual(computer, L) if work_place(_, L).
usual(cup, kitchen).
usual(chair, kitchen).
usual(books, library).
usual(sofa, library).
usual(chair, library).
usual(plant, library).
usual(plant, kitchen).

% What follows

%% an object is unusual at a place where it is not usually
unusual(O, L) if present(O, L), not usual(O, L).
%% a place is cluttered where three or more objects are that are not usually there
cluttered(L) if place(L), #count { O : unusual(O, L) } >= 3.

% What a picture says

%% a room with Bob in it is occupied
occupied(V) if bob(V).
%% a room with John in it is occupied
occupied(V) if john(V).
%% a room with Sarah in it is occupied
occupied(V) if sarah(V).
%% a room with Sally in it is occupied
occupied(V) if sally(V).
%% a room without any of the people is empty
-occupied(V) if -bob(V), -john(V), -sarah(V), -sally(V).
