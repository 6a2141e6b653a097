% What a driver knows of Belgian traffic signs. Shapes, colours and symbols are those of
% classes.csv; a symbol is named after what it looks like in some places and after what it
% stands for in others.

#sort sign.
#sort figure = {triangle, inverted_triangle, circle, octagon, tall_rectangle, wide_rectangle,
    square, diamond}.
#sort color = {white, red, blue}.
#sort background = {none, triangle, square}.
#sort symbol = {bumpy_road, bump, slippery_road, left_turn, right_turn, left_then_right,
    right_then_left, people, cyclist, cow, road_worker, traffic_lights, fence, danger,
    narrow_road, narrow_on_left, narrow_on_right, priority_to_through_traffic, cross, blank,
    oncoming_traffic, stop, do_not_enter, weight_limit, truck, width_limit, height_limit,
    no_passing, speed_limit, arrow, side_arrow, straight_or_right, yield, paths, numbers, p,
    children, barrier, pedestrian}.
#sort addition = {none, people, one_and_fifteen, sixteen_and_thirtyone, disabled, car, truck,
    bus, fence, arrow}.
#sort bar = {none, red, black}.
#sort information = {uneven_road_ahead, speed_bump_ahead, road_may_be_slippery,
    bend_to_the_left_ahead, bend_to_the_right_ahead, double_bend_ahead_first_to_the_left,
    double_bend_ahead_first_to_the_right, children_near_the_road, cyclists_cross_ahead,
    cattle_on_the_road, road_works_ahead, traffic_lights_ahead,
    level_crossing_with_barriers_ahead, danger_ahead, road_narrows_ahead,
    road_narrows_on_the_left, road_narrows_on_the_right, priority_at_the_next_junction,
    traffic_from_the_right_has_priority, the_crossing_road_has_priority,
    oncoming_traffic_has_priority, everyone_must_stop_here, entry_is_forbidden,
    bicycles_are_forbidden, heavier_vehicles_are_forbidden, lorries_are_forbidden,
    wider_vehicles_are_forbidden, higher_vehicles_are_forbidden, all_vehicles_are_forbidden,
    turning_left_is_forbidden, turning_right_is_forbidden, overtaking_is_forbidden,
    speed_is_limited, path_shared_by_pedestrians_and_cyclists, straight_ahead_only,
    only_in_the_direction_of_the_arrow, straight_ahead_or_right_only, roundabout_ahead,
    path_for_cyclists, separate_paths_for_pedestrians_and_cyclists, parking_is_forbidden,
    stopping_and_parking_are_forbidden, parking_is_forbidden_from_the_1st_to_the_15th,
    parking_is_forbidden_from_the_16th_to_the_31st, you_have_priority_over_oncoming_traffic,
    parking_is_allowed, parking_for_disabled_drivers, parking_for_cars, parking_for_lorries,
    parking_for_coaches, parking_on_the_pavement, residential_zone_begins,
    residential_zone_ends, one_way_street, the_road_is_a_dead_end, road_works_end,
    pedestrians_cross_here, cyclists_cross_here, parking_in_the_direction_of_the_arrow,
    road_hump_here, priority_road_ends, you_are_on_a_priority_road}.
#sort action = {slow_down, brake_gently, be_ready_to_stop, keep_right, keep_left, go_first,
    give_way, stop, not_enter, not_enter_on_a_bicycle, know_the_vehicle, not_enter_with_a_lorry,
    not_turn_left, not_turn_right, not_overtake, keep_to_the_limit, keep_off_the_path,
    go_straight_ahead, go_where_the_arrow_points, go_round_the_roundabout, not_park_here,
    not_stop_here, check_the_date, park_here, leave_the_place_to_others, park_on_the_pavement,
    drive_at_walking_pace, follow_the_usual_rules, not_expect_a_way_through,
    give_way_to_pedestrians, give_way_to_cyclists, follow_the_arrow_to_park,
    be_ready_to_give_way}.

#static shape(sign, figure).
#static main_color(sign, color).
#static border_color(sign, color).
#static background_image(sign, background).
#static primary_symbol(sign, symbol).
#static secondary_symbol(sign, addition).
#static cross(sign, bar).

#static message(sign, information).
#static response(sign, action).

#static uneven_road(sign).
#static speed_bump(sign).
#static slippery_road(sign).
#static bend_left(sign).
#static bend_right(sign).
#static double_bend_left(sign).
#static double_bend_right(sign).
#static children_ahead(sign).
#static cyclists_ahead(sign).
#static cattle_ahead(sign).
#static road_works(sign).
#static traffic_lights_ahead(sign).
#static level_crossing(sign).
#static other_danger(sign).
#static narrows_both(sign).
#static narrows_left(sign).
#static narrows_right(sign).
#static priority_at_junction(sign).
#static priority_from_right(sign).
#static give_way(sign).
#static give_way_to_oncoming(sign).
#static stop_sign(sign).
#static no_entry(sign).
#static no_bicycles(sign).
#static weight_limited(sign).
#static no_lorries(sign).
#static width_limited(sign).
#static height_limited(sign).
#static no_vehicles(sign).
#static no_left_turn(sign).
#static no_right_turn(sign).
#static no_overtaking(sign).
#static speed_limited(sign).
#static shared_path(sign).
#static straight_ahead(sign).
#static follow_the_arrow(sign).
#static straight_or_right_only(sign).
#static roundabout(sign).
#static cycle_path(sign).
#static separate_paths(sign).
#static no_parking(sign).
#static no_stopping(sign).
#static no_parking_first_half(sign).
#static no_parking_second_half(sign).
#static priority_over_oncoming(sign).
#static parking(sign).
#static parking_disabled(sign).
#static parking_cars(sign).
#static parking_lorries(sign).
#static parking_coaches(sign).
#static parking_on_pavement(sign).
#static residential_zone(sign).
#static end_of_residential_zone(sign).
#static one_way_street(sign).
#static dead_end(sign).
#static end_of_road_works(sign).
#static pedestrian_crossing(sign).
#static cycle_crossing(sign).
#static parking_arrow(sign).
#static road_hump(sign).
#static end_of_priority_road(sign).
#static priority_road(sign).

% Symbols by their use.
#static danger_symbol(symbol).
#static turn_symbol(symbol).
#static restriction_symbol(symbol).
#static direction_symbol(symbol).
#static parking_ban_symbol(symbol).
#static may_have_second(symbol).
#static parking_addition(addition).
#static half_of_month(addition).
#static panel(figure).

danger_symbol(bumpy_road).
danger_symbol(slippery_road).
danger_symbol(left_then_right).
danger_symbol(right_then_left).
danger_symbol(cow).
danger_symbol(traffic_lights).
danger_symbol(danger).
danger_symbol(narrow_road).
danger_symbol(narrow_on_left).
danger_symbol(narrow_on_right).

turn_symbol(left_turn).
turn_symbol(right_turn).

restriction_symbol(weight_limit).
restriction_symbol(width_limit).
restriction_symbol(height_limit).
restriction_symbol(speed_limit).
restriction_symbol(truck).

direction_symbol(side_arrow).
direction_symbol(straight_or_right).

parking_ban_symbol(blank).
parking_ban_symbol(cross).
parking_ban_symbol(numbers).

may_have_second(cyclist).
may_have_second(numbers).
may_have_second(p).

parking_addition(disabled).
parking_addition(car).
parking_addition(truck).
parking_addition(bus).
parking_addition(arrow).

half_of_month(one_and_fifteen).
half_of_month(sixteen_and_thirtyone).

panel(square).
panel(tall_rectangle).
panel(wide_rectangle).

% Conventions: how signs are made. They classify nothing; where a sign does not keep to them,
% the beliefs contradict each other.

% Colours and additions.

%% a white sign has a red border
border_color(S, red) if main_color(S, white).

%% a white sign has a plain background
background_image(S, none) if main_color(S, white).

%% only cyclists, dates and the letter P come with a second symbol
secondary_symbol(S, none) if primary_symbol(S, X), not may_have_second(X).

%% a white sign has no second symbol
secondary_symbol(S, none) if main_color(S, white).

% Triangles warn.

%% a danger is shown on a triangle
shape(S, triangle) if primary_symbol(S, X), danger_symbol(X).

%% a triangle is white
main_color(S, white) if shape(S, triangle).

%% a triangle is never crossed out
cross(S, none) if shape(S, triangle).

% Three shapes with one meaning each, to be known from behind or under snow.

%% a triangle that stands on its tip is white
main_color(S, white) if shape(S, inverted_triangle).

%% a triangle that stands on its tip is empty
primary_symbol(S, blank) if shape(S, inverted_triangle).

%% a triangle that stands on its tip is never crossed out
cross(S, none) if shape(S, inverted_triangle).

%% an octagon is red
main_color(S, red) if shape(S, octagon).

%% an octagon has a white border
border_color(S, white) if shape(S, octagon).

%% an octagon has a plain background
background_image(S, none) if shape(S, octagon).

%% an octagon says stop
primary_symbol(S, stop) if shape(S, octagon).

%% an octagon is never crossed out
cross(S, none) if shape(S, octagon).

%% only a diamond is crossed out in black
shape(S, diamond) if cross(S, black).

%% a diamond has a white border
border_color(S, white) if shape(S, diamond).

%% a diamond has a square within
background_image(S, square) if shape(S, diamond).

%% a diamond is empty
primary_symbol(S, blank) if shape(S, diamond).

% Circles forbid and command.

%% a circle has a plain background
background_image(S, none) if shape(S, circle).

%% a limit is shown on a circle
shape(S, circle) if primary_symbol(S, X), restriction_symbol(X).

%% a limit is shown on white
main_color(S, white) if primary_symbol(S, X), restriction_symbol(X).

%% a turn is shown on white
main_color(S, white) if primary_symbol(S, X), turn_symbol(X).

%% a circle forbids a turn by crossing it out in red
cross(S, red) if shape(S, circle), primary_symbol(S, X), turn_symbol(X).

%% a white circle crosses out nothing but turns
cross(S, none) if shape(S, circle), main_color(S, white), primary_symbol(S, X), not turn_symbol(X).

%% a circle that shows oncoming traffic is white
main_color(S, white) if shape(S, circle), primary_symbol(S, oncoming_traffic).

%% the bar that forbids entry is shown on red
main_color(S, red) if primary_symbol(S, do_not_enter).

%% the bar that forbids entry stands within a red border
border_color(S, red) if primary_symbol(S, do_not_enter).

%% the bar that forbids entry is never crossed out
cross(S, none) if primary_symbol(S, do_not_enter).

%% a direction to take is shown on a circle
shape(S, circle) if primary_symbol(S, X), direction_symbol(X).

%% a direction to take is shown on blue
main_color(S, blue) if primary_symbol(S, X), direction_symbol(X).

%% a direction to take has a white border
border_color(S, white) if primary_symbol(S, X), direction_symbol(X).

%% an arrow is shown on blue
main_color(S, blue) if primary_symbol(S, arrow).

%% an arrow has a white border
border_color(S, white) if primary_symbol(S, arrow).

%% a circle with a white border commands, and is never crossed out
cross(S, none) if shape(S, circle), border_color(S, white).

%% a blue sign for cyclists has a white border
border_color(S, white) if main_color(S, blue), primary_symbol(S, cyclist).

%% people as a second symbol are shown beside a cyclist
primary_symbol(S, cyclist) if secondary_symbol(S, people).

%% a path for people and cyclists is shown on a circle
shape(S, circle) if secondary_symbol(S, people).

%% a path for people and cyclists is shown on blue
main_color(S, blue) if secondary_symbol(S, people).

% Blue circles with a red border are about parking.

%% dates stand on blue
main_color(S, blue) if primary_symbol(S, numbers).

%% half of a month is shown by dates
primary_symbol(S, numbers) if secondary_symbol(S, X), half_of_month(X).

%% parking is forbidden within a red border
border_color(S, red) if main_color(S, blue), primary_symbol(S, X), parking_ban_symbol(X).

%% a single red bar forbids parking
cross(S, red) if main_color(S, blue), primary_symbol(S, X), parking_ban_symbol(X), X != cross.

%% a red cross that forbids stopping needs no further bar
cross(S, none) if main_color(S, blue), primary_symbol(S, cross).

% Rectangles and squares inform.

%% rectangles and squares are blue
main_color(S, blue) if shape(S, X), panel(X).

%% who may park is shown below the letter P
primary_symbol(S, p) if secondary_symbol(S, X), parking_addition(X).

%% the letter P stands on a tall rectangle
shape(S, tall_rectangle) if primary_symbol(S, p).

%% the letter P stands within a blue border
border_color(S, blue) if primary_symbol(S, p).

%% only an arrow turns the background of the letter P into a square
background_image(S, square) if primary_symbol(S, p), secondary_symbol(S, arrow).

%% the letter P without an arrow has a plain background
background_image(S, none) if primary_symbol(S, p), secondary_symbol(S, X), X != arrow.

%% a tall rectangle without the letter P has a white border
border_color(S, white) if shape(S, tall_rectangle), primary_symbol(S, X), X != p.

%% a tall rectangle without the letter P has a plain background
background_image(S, none) if shape(S, tall_rectangle), primary_symbol(S, X), X != p.

%% a tall rectangle crosses out the road worker
cross(S, red) if shape(S, tall_rectangle), primary_symbol(S, road_worker).

%% a tall rectangle crosses out nothing but the road worker
cross(S, none) if shape(S, tall_rectangle), primary_symbol(S, X), X != road_worker.

%% a wide rectangle has a white border
border_color(S, white) if shape(S, wide_rectangle).

%% a wide rectangle has a plain background
background_image(S, none) if shape(S, wide_rectangle).

%% a wide rectangle shows children at play
primary_symbol(S, children) if shape(S, wide_rectangle).

%% a pedestrian is shown on a square
shape(S, square) if primary_symbol(S, pedestrian).

%% a square has a white border
border_color(S, white) if shape(S, square).

%% a square has no second symbol
secondary_symbol(S, none) if shape(S, square).

%% a square is never crossed out
cross(S, none) if shape(S, square).

%% a square with an arrow has a plain background
background_image(S, none) if shape(S, square), primary_symbol(S, arrow).

%% a square that shows something else than an arrow shows it in a triangle
background_image(S, triangle) if shape(S, square), primary_symbol(S, X), X != arrow.

% Which sign it is, each told from all others by as few features as can be.
% Eight signs are left out: their symbol has to be seen to be known.

%% bumps along the road mean an uneven road
uneven_road(S) if primary_symbol(S, bumpy_road).

%% a bump on a triangle warns of a speed bump
speed_bump(S) if shape(S, triangle), primary_symbol(S, bump).

%% a car that skids means a slippery road
slippery_road(S) if primary_symbol(S, slippery_road).

%% a turn to the left on a triangle warns of a bend to the left
bend_left(S) if shape(S, triangle), primary_symbol(S, left_turn).

%% a turn to the right on a triangle warns of a bend to the right
bend_right(S) if shape(S, triangle), primary_symbol(S, right_turn).

%% a line that goes left and then right means a double bend, first to the left
double_bend_left(S) if primary_symbol(S, left_then_right).

%% a line that goes right and then left means a double bend, first to the right
double_bend_right(S) if primary_symbol(S, right_then_left).

%% a cyclist on a triangle warns of cyclists who cross
cyclists_ahead(S) if shape(S, triangle), primary_symbol(S, cyclist).

%% a cow warns of cattle
cattle_ahead(S) if primary_symbol(S, cow).

%% a worker on a triangle warns of road works
road_works(S) if shape(S, triangle), primary_symbol(S, road_worker).

%% a picture of traffic lights warns of traffic lights
traffic_lights_ahead(S) if primary_symbol(S, traffic_lights).

%% an exclamation mark warns of a danger
other_danger(S) if primary_symbol(S, danger).

%% two lines that come closer mean that the road narrows
narrows_both(S) if primary_symbol(S, narrow_road).

%% a left line that comes closer means that the road narrows on the left
narrows_left(S) if primary_symbol(S, narrow_on_left).

%% a right line that comes closer means that the road narrows on the right
narrows_right(S) if primary_symbol(S, narrow_on_right).

%% a cross on a triangle means a junction with priority from the right
priority_from_right(S) if shape(S, triangle), primary_symbol(S, cross).

%% a triangle that stands on its tip means give way
give_way(S) if shape(S, inverted_triangle).

%% on a circle, arrows against each other mean give way to oncoming traffic
give_way_to_oncoming(S) if shape(S, circle), primary_symbol(S, oncoming_traffic).

%% an octagon means stop
stop_sign(S) if shape(S, octagon).

%% a white bar means no entry
no_entry(S) if primary_symbol(S, do_not_enter).

%% a cyclist on a white circle means that bicycles are forbidden
no_bicycles(S) if shape(S, circle), main_color(S, white), primary_symbol(S, cyclist).

%% a number of tonnes limits the weight
weight_limited(S) if primary_symbol(S, weight_limit).

%% a lorry as the main symbol means that lorries are forbidden
no_lorries(S) if primary_symbol(S, truck).

%% a width between two arrowheads limits the width
width_limited(S) if primary_symbol(S, width_limit).

%% a height between two arrowheads limits the height
height_limited(S) if primary_symbol(S, height_limit).

%% a white circle without a symbol is closed to all vehicles
no_vehicles(S) if shape(S, circle), main_color(S, white), primary_symbol(S, blank).

%% a turn to the left on a circle means that nobody may turn left
no_left_turn(S) if shape(S, circle), primary_symbol(S, left_turn).

%% a turn to the right on a circle means that nobody may turn right
no_right_turn(S) if shape(S, circle), primary_symbol(S, right_turn).

%% a number alone limits the speed
speed_limited(S) if primary_symbol(S, speed_limit).

%% people beside a cyclist share a path with cyclists
shared_path(S) if secondary_symbol(S, people).

%% an arrow on a circle means straight ahead only
straight_ahead(S) if shape(S, circle), primary_symbol(S, arrow).

%% an arrow to the side has to be followed
follow_the_arrow(S) if primary_symbol(S, side_arrow).

%% an arrow with two heads means straight ahead or right only
straight_or_right_only(S) if primary_symbol(S, straight_or_right).

%% a cyclist alone on a blue circle means a cycle path
cycle_path(S) if shape(S, circle), main_color(S, blue), primary_symbol(S, cyclist),
    secondary_symbol(S, none).

%% a blue sign without a symbol means no parking
no_parking(S) if main_color(S, blue), primary_symbol(S, blank).

%% a cross on blue means no stopping
no_stopping(S) if main_color(S, blue), primary_symbol(S, cross).

%% the dates 1 and 15 mean no parking in the first half of the month
no_parking_first_half(S) if secondary_symbol(S, one_and_fifteen).

%% the dates 16 and 31 mean no parking in the second half of the month
no_parking_second_half(S) if secondary_symbol(S, sixteen_and_thirtyone).

%% on a tall rectangle, arrows against each other mean priority over oncoming traffic
priority_over_oncoming(S) if shape(S, tall_rectangle), primary_symbol(S, oncoming_traffic).

%% the letter P alone means parking
parking(S) if primary_symbol(S, p), secondary_symbol(S, none).

%% a wheelchair keeps a parking place for disabled drivers
parking_disabled(S) if secondary_symbol(S, disabled).

%% a car as the second symbol means parking for cars
parking_cars(S) if secondary_symbol(S, car).

%% a lorry as the second symbol means parking for lorries
parking_lorries(S) if secondary_symbol(S, truck).

%% a bus as the second symbol means parking for coaches
parking_coaches(S) if secondary_symbol(S, bus).

%% a wide rectangle that is not crossed out begins a residential zone
residential_zone(S) if shape(S, wide_rectangle), cross(S, none).

%% a wide rectangle that is crossed out in red ends a residential zone
end_of_residential_zone(S) if shape(S, wide_rectangle), cross(S, red).

%% an arrow on a square means a one-way street
one_way_street(S) if shape(S, square), primary_symbol(S, arrow).

%% a worker on a tall rectangle means that the road works end
end_of_road_works(S) if shape(S, tall_rectangle), primary_symbol(S, road_worker).

%% a walking person means a pedestrian crossing
pedestrian_crossing(S) if primary_symbol(S, pedestrian).

%% a cyclist on a square means a crossing for cyclists
cycle_crossing(S) if shape(S, square), primary_symbol(S, cyclist).

%% an arrow as the second symbol shows the way to the parking place
parking_arrow(S) if secondary_symbol(S, arrow).

%% a bump on a square marks a road hump
road_hump(S) if shape(S, square), primary_symbol(S, bump).

%% a black bar ends the priority road
end_of_priority_road(S) if cross(S, black).

%% a diamond that is not crossed out marks a priority road
priority_road(S) if shape(S, diamond), cross(S, none).


% What the signs tell the driver, and what the driver does.

%% an uneven road sign tells the driver: uneven road ahead
message(S, uneven_road_ahead) if uneven_road(S).

%% on an uneven road the driver slows down
response(S, slow_down) if uneven_road(S).

%% a speed bump sign tells the driver: speed bump ahead
message(S, speed_bump_ahead) if speed_bump(S).

%% before a speed bump the driver slows down
response(S, slow_down) if speed_bump(S).

%% a slippery road sign tells the driver: road may be slippery
message(S, road_may_be_slippery) if slippery_road(S).

%% on a slippery road the driver brakes and steers gently
response(S, brake_gently) if slippery_road(S).

%% a left bend sign tells the driver: bend to the left ahead
message(S, bend_to_the_left_ahead) if bend_left(S).

%% before a bend the driver slows down
response(S, slow_down) if bend_left(S).

%% a right bend sign tells the driver: bend to the right ahead
message(S, bend_to_the_right_ahead) if bend_right(S).

%% before a bend the driver slows down
response(S, slow_down) if bend_right(S).

%% a sign of a double bend, first to the left tells the driver:
%% double bend ahead first to the left
message(S, double_bend_ahead_first_to_the_left) if double_bend_left(S).

%% before a double bend the driver slows down
response(S, slow_down) if double_bend_left(S).

%% a sign of a double bend, first to the right tells the driver:
%% double bend ahead first to the right
message(S, double_bend_ahead_first_to_the_right) if double_bend_right(S).

%% before a double bend the driver slows down
response(S, slow_down) if double_bend_right(S).

%% a children sign tells the driver: children near the road
message(S, children_near_the_road) if children_ahead(S).

%% where children may run onto the road the driver is ready to stop
response(S, be_ready_to_stop) if children_ahead(S).

%% a cyclists ahead sign tells the driver: cyclists cross ahead
message(S, cyclists_cross_ahead) if cyclists_ahead(S).

%% where cyclists cross the driver is ready to stop
response(S, be_ready_to_stop) if cyclists_ahead(S).

%% a cattle sign tells the driver: cattle on the road
message(S, cattle_on_the_road) if cattle_ahead(S).

%% where cattle cross the driver is ready to stop
response(S, be_ready_to_stop) if cattle_ahead(S).

%% a road works sign tells the driver: road works ahead
message(S, road_works_ahead) if road_works(S).

%% at road works the driver slows down
response(S, slow_down) if road_works(S).

%% a traffic lights sign tells the driver: traffic lights ahead
message(S, traffic_lights_ahead) if traffic_lights_ahead(S).

%% before traffic lights the driver is ready to stop
response(S, be_ready_to_stop) if traffic_lights_ahead(S).

%% a level crossing sign tells the driver: level crossing with barriers ahead
message(S, level_crossing_with_barriers_ahead) if level_crossing(S).

%% before a level crossing the driver is ready to stop
response(S, be_ready_to_stop) if level_crossing(S).

%% a danger sign tells the driver: danger ahead
message(S, danger_ahead) if other_danger(S).

%% before a danger the driver slows down
response(S, slow_down) if other_danger(S).

%% a road narrows sign tells the driver: road narrows ahead
message(S, road_narrows_ahead) if narrows_both(S).

%% where the road narrows the driver slows down
response(S, slow_down) if narrows_both(S).

%% a road narrows on the left sign tells the driver: road narrows on the left
message(S, road_narrows_on_the_left) if narrows_left(S).

%% where the road narrows on the left the driver keeps to the right
response(S, keep_right) if narrows_left(S).

%% a road narrows on the right sign tells the driver: road narrows on the right
message(S, road_narrows_on_the_right) if narrows_right(S).

%% where the road narrows on the right the driver keeps to the left
response(S, keep_left) if narrows_right(S).

%% a sign of priority at the next junction tells the driver: priority at the next junction
message(S, priority_at_the_next_junction) if priority_at_junction(S).

%% who has priority at the junction goes first
response(S, go_first) if priority_at_junction(S).

%% a priority from the right sign tells the driver: traffic from the right has priority
message(S, traffic_from_the_right_has_priority) if priority_from_right(S).

%% the driver gives way to who comes from the right
response(S, give_way) if priority_from_right(S).

%% a give way sign tells the driver: the crossing road has priority
message(S, the_crossing_road_has_priority) if give_way(S).

%% at a give way sign the driver gives way
response(S, give_way) if give_way(S).

%% a give way to oncoming traffic sign tells the driver: oncoming traffic has priority
message(S, oncoming_traffic_has_priority) if give_way_to_oncoming(S).

%% the driver gives way to oncoming traffic
response(S, give_way) if give_way_to_oncoming(S).

%% a stop sign tells the driver: everyone must stop here
message(S, everyone_must_stop_here) if stop_sign(S).

%% at a stop sign the driver stops
response(S, stop) if stop_sign(S).

%% a no entry sign tells the driver: entry is forbidden
message(S, entry_is_forbidden) if no_entry(S).

%% the driver does not enter a road from its wrong end
response(S, not_enter) if no_entry(S).

%% a no bicycles sign tells the driver: bicycles are forbidden
message(S, bicycles_are_forbidden) if no_bicycles(S).

%% who rides a bicycle does not enter
response(S, not_enter_on_a_bicycle) if no_bicycles(S).

%% a weight limit sign tells the driver: heavier vehicles are forbidden
message(S, heavier_vehicles_are_forbidden) if weight_limited(S).

%% the driver checks the weight of the vehicle
response(S, know_the_vehicle) if weight_limited(S).

%% a no lorries sign tells the driver: lorries are forbidden
message(S, lorries_are_forbidden) if no_lorries(S).

%% who drives a lorry does not enter
response(S, not_enter_with_a_lorry) if no_lorries(S).

%% a width limit sign tells the driver: wider vehicles are forbidden
message(S, wider_vehicles_are_forbidden) if width_limited(S).

%% the driver checks the width of the vehicle
response(S, know_the_vehicle) if width_limited(S).

%% a height limit sign tells the driver: higher vehicles are forbidden
message(S, higher_vehicles_are_forbidden) if height_limited(S).

%% the driver checks the height of the vehicle
response(S, know_the_vehicle) if height_limited(S).

%% a no vehicles sign tells the driver: all vehicles are forbidden
message(S, all_vehicles_are_forbidden) if no_vehicles(S).

%% nobody drives into a road that is closed to vehicles
response(S, not_enter) if no_vehicles(S).

%% a no left turn sign tells the driver: turning left is forbidden
message(S, turning_left_is_forbidden) if no_left_turn(S).

%% the driver does not turn left
response(S, not_turn_left) if no_left_turn(S).

%% a no right turn sign tells the driver: turning right is forbidden
message(S, turning_right_is_forbidden) if no_right_turn(S).

%% the driver does not turn right
response(S, not_turn_right) if no_right_turn(S).

%% a no overtaking sign tells the driver: overtaking is forbidden
message(S, overtaking_is_forbidden) if no_overtaking(S).

%% where nobody may overtake the driver stays behind
response(S, not_overtake) if no_overtaking(S).

%% a speed limit sign tells the driver: speed is limited
message(S, speed_is_limited) if speed_limited(S).

%% the driver goes no faster than the sign says
response(S, keep_to_the_limit) if speed_limited(S).

%% a shared path sign tells the driver: path shared by pedestrians and cyclists
message(S, path_shared_by_pedestrians_and_cyclists) if shared_path(S).

%% the driver keeps off a path for others
response(S, keep_off_the_path) if shared_path(S).

%% a straight ahead only sign tells the driver: straight ahead only
message(S, straight_ahead_only) if straight_ahead(S).

%% the driver goes straight ahead
response(S, go_straight_ahead) if straight_ahead(S).

%% a follow the arrow sign tells the driver: only in the direction of the arrow
message(S, only_in_the_direction_of_the_arrow) if follow_the_arrow(S).

%% the driver goes where the arrow points
response(S, go_where_the_arrow_points) if follow_the_arrow(S).

%% a straight ahead or right only sign tells the driver: straight ahead or right only
message(S, straight_ahead_or_right_only) if straight_or_right_only(S).

%% who may go straight ahead or right does not turn left
response(S, not_turn_left) if straight_or_right_only(S).

%% a roundabout sign tells the driver: roundabout ahead
message(S, roundabout_ahead) if roundabout(S).

%% the driver goes round the roundabout in the direction of the arrows
response(S, go_round_the_roundabout) if roundabout(S).

%% a cycle path sign tells the driver: path for cyclists
message(S, path_for_cyclists) if cycle_path(S).

%% the driver keeps off a path for others
response(S, keep_off_the_path) if cycle_path(S).

%% a separate paths sign tells the driver: separate paths for pedestrians and cyclists
message(S, separate_paths_for_pedestrians_and_cyclists) if separate_paths(S).

%% the driver keeps off a path for others
response(S, keep_off_the_path) if separate_paths(S).

%% a no parking sign tells the driver: parking is forbidden
message(S, parking_is_forbidden) if no_parking(S).

%% the driver parks elsewhere
response(S, not_park_here) if no_parking(S).

%% a no stopping sign tells the driver: stopping and parking are forbidden
message(S, stopping_and_parking_are_forbidden) if no_stopping(S).

%% the driver does not even stop, but drives on
response(S, not_stop_here) if no_stopping(S).

%% a sign of no parking from the 1st to the 15th tells the driver:
%% parking is forbidden from the 1st to the 15th
message(S, parking_is_forbidden_from_the_1st_to_the_15th) if no_parking_first_half(S).

%% the driver looks at the date before parking
response(S, check_the_date) if no_parking_first_half(S).

%% a sign of no parking from the 16th to the 31st tells the driver:
%% parking is forbidden from the 16th to the 31st
message(S, parking_is_forbidden_from_the_16th_to_the_31st) if no_parking_second_half(S).

%% the driver looks at the date before parking
response(S, check_the_date) if no_parking_second_half(S).

%% a priority over oncoming traffic sign tells the driver:
%% you have priority over oncoming traffic
message(S, you_have_priority_over_oncoming_traffic) if priority_over_oncoming(S).

%% who has priority over oncoming traffic goes first
response(S, go_first) if priority_over_oncoming(S).

%% a parking sign tells the driver: parking is allowed
message(S, parking_is_allowed) if parking(S).

%% the driver may park here
response(S, park_here) if parking(S).

%% a disabled parking sign tells the driver: parking for disabled drivers
message(S, parking_for_disabled_drivers) if parking_disabled(S).

%% the place is kept for disabled drivers
response(S, leave_the_place_to_others) if parking_disabled(S).

%% a car parking sign tells the driver: parking for cars
message(S, parking_for_cars) if parking_cars(S).

%% who drives a car may park here
response(S, park_here) if parking_cars(S).

%% a lorry parking sign tells the driver: parking for lorries
message(S, parking_for_lorries) if parking_lorries(S).

%% the place is kept for lorries
response(S, leave_the_place_to_others) if parking_lorries(S).

%% a coach parking sign tells the driver: parking for coaches
message(S, parking_for_coaches) if parking_coaches(S).

%% the place is kept for coaches
response(S, leave_the_place_to_others) if parking_coaches(S).

%% a parking on the pavement sign tells the driver: parking on the pavement
message(S, parking_on_the_pavement) if parking_on_pavement(S).

%% the driver parks on the pavement
response(S, park_on_the_pavement) if parking_on_pavement(S).

%% a residential zone sign tells the driver: residential zone begins
message(S, residential_zone_begins) if residential_zone(S).

%% in a residential zone the driver goes at walking pace
response(S, drive_at_walking_pace) if residential_zone(S).

%% an end of residential zone sign tells the driver: residential zone ends
message(S, residential_zone_ends) if end_of_residential_zone(S).

%% where a zone ends the usual rules apply again
response(S, follow_the_usual_rules) if end_of_residential_zone(S).

%% a one-way street sign tells the driver: one way street
message(S, one_way_street) if one_way_street(S).

%% in a one-way street the driver goes the way of the arrow
response(S, go_straight_ahead) if one_way_street(S).

%% a dead end sign tells the driver: the road is a dead end
message(S, the_road_is_a_dead_end) if dead_end(S).

%% a dead end leads nobody through
response(S, not_expect_a_way_through) if dead_end(S).

%% an end of road works sign tells the driver: road works end
message(S, road_works_end) if end_of_road_works(S).

%% where road works end the usual rules apply again
response(S, follow_the_usual_rules) if end_of_road_works(S).

%% a pedestrian crossing sign tells the driver: pedestrians cross here
message(S, pedestrians_cross_here) if pedestrian_crossing(S).

%% the driver gives way to pedestrians on the crossing
response(S, give_way_to_pedestrians) if pedestrian_crossing(S).

%% a cycle crossing sign tells the driver: cyclists cross here
message(S, cyclists_cross_here) if cycle_crossing(S).

%% the driver lets cyclists cross
response(S, give_way_to_cyclists) if cycle_crossing(S).

%% a parking arrow sign tells the driver: parking in the direction of the arrow
message(S, parking_in_the_direction_of_the_arrow) if parking_arrow(S).

%% who looks for a place to park follows the arrow
response(S, follow_the_arrow_to_park) if parking_arrow(S).

%% a road hump sign tells the driver: road hump here
message(S, road_hump_here) if road_hump(S).

%% over a road hump the driver goes slowly
response(S, slow_down) if road_hump(S).

%% an end of priority road sign tells the driver: priority road ends
message(S, priority_road_ends) if end_of_priority_road(S).

%% where the priority road ends the driver is ready to give way
response(S, be_ready_to_give_way) if end_of_priority_road(S).

%% a priority road sign tells the driver: you are on a priority road
message(S, you_are_on_a_priority_road) if priority_road(S).

%% on a priority road the driver goes first
response(S, go_first) if priority_road(S).
