% What a robot knows that stacks boxes with a gripper, and which stacks would not stand.

#sort robot = {rob1}.
#sort box = {b1, b2, b3, b4, b5, b6}.
#sort surface = {table}.
#sort place = box + surface.
#sort num = 1..6.

#static large(box).
#static round(box).
#static slanted(box).
#static unfit(box, box).

#fluent basic on(box, place).
#fluent basic holding(robot, box).
#fluent basic heavy(box).
#fluent defined covered(box).
#fluent defined above(box, box).
#fluent defined base(box, box).
#fluent defined height(box, num).
#fluent defined tower_of(num).
#fluent defined unsteady(box, box).
#fluent defined unstable(box).
#fluent defined stable(box).

#action pick_up(robot, box).
#action put(robot, box, place).
#action exogenous slip(box).
#action exogenous topple(box).
#action exogenous fill(box).

% The boxes: two small ones, two large ones, a ball and a roof

large(b3).
large(b4).
round(b5).
slanted(b6).

% What actions do

%% who picks up a box holds it
pick_up(R, B) causes holding(R, B).
%% a box that is put somewhere is there
put(R, B, P) causes on(B, P).
%% a box that slips from the gripper falls on the table
slip(B) causes on(B, table).
%% a box that topples falls on the table
topple(B) causes on(B, table).
%% the boxes above one that topples fall with it
topple(B) causes on(A, table) if above(A, B).
%% a box that somebody fills is heavy
fill(B) causes heavy(B).

% What is so in every state

%% a box is on one thing only
-on(B, P2) if on(B, P1), P1 != P2.
%% a box carries one box only
-on(A, C) if on(B, C), A != B, box(C).
%% nothing is on what stands above it
-on(A, B) if above(B, A).
%% a box that is held is on nothing
-on(B, P) if holding(R, B).
%% a box that is on something is not held
-holding(R, B) if on(B, P).
%% the gripper holds one box
-holding(R, B2) if holding(R, B1), B1 != B2.
%% nothing is on a box that is held
-on(A, B) if holding(R, B).

% What is impossible

%% the gripper picks up one box at a time
impossible pick_up(R, B) if holding(R, A).
%% a box that carries another cannot be picked up
impossible pick_up(R, B) if covered(B).
%% only a box that is held can be put somewhere
impossible put(R, B, P) if not holding(R, B).
%% there is no room on a box that carries another
impossible put(R, B, P) if covered(P), box(P).
%% a box is not put on itself
impossible put(R, B, B) if box(B).
%% a box is not put where no such box ever stays
impossible put(R, B, C) if unfit(B, C).
%% a box is not put where it would not stay
impossible put(R, B, C) if unsteady(B, C), box(C).
impossible slip(B) if not holding(rob1, B).
impossible topple(B) if on(B, table).
impossible topple(B) if holding(R, B).
impossible fill(B) if heavy(B).
%% boxes are filled where they stand alone
impossible fill(B) if covered(B).
impossible fill(B) if on(B, C), box(C).

% What is usual at first

%% boxes are on the table
default on(B, table).
%% boxes are light
default -heavy(B).
%% the gripper is empty
default -holding(R, B).

% What follows

covered(B) if on(A, B).
above(A, B) if on(A, B).
above(A, C) if on(A, B), above(B, C).
base(B, B) if on(B, table).
base(A, C) if on(A, B), base(B, C).
%% a box on the table is one box high
height(B, 1) if on(B, table).
%% a box is one higher than the box that it is on
height(A, N + 1) if on(A, B), height(B, N).
%% a tower is as high as its topmost box
tower_of(N) if height(B, N), not covered(B).

% Which stacks would not stand

%% a large box does not stay on a small one
unfit(A, B) if large(A), box(B), not large(B).
%% nothing stays on a ball
unfit(A, B) if box(A), round(B).
%% nothing stays on a roof
unfit(A, B) if box(A), slanted(B).
unsteady(A, B) if unfit(A, B).
%% a heavy box crushes a light one
unsteady(A, B) if heavy(A), -heavy(B).
%% no more than two boxes stand on a small base
unsteady(A, B) if box(A), base(B, C), not large(C), height(B, N), N >= 2.
%% a box is unstable on a box that it does not stay on
unstable(A) if on(A, B), unsteady(A, B).
%% what stands on an unstable box is unstable
unstable(A) if on(A, B), unstable(B).
%% a box that is on something and not unstable is stable
stable(B) if on(B, P), not unstable(B).
