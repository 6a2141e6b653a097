% The signature: sorts, and statics over them. 'card' is the picture at hand.
#sort card.
#sort kind = {n1_green_empty_diamond, n1_green_empty_oval, n1_green_empty_squiggle,
    n1_green_solid_diamond, n1_green_solid_oval, n1_green_solid_squiggle,
    n1_green_striped_diamond, n1_green_striped_oval, n1_green_striped_squiggle,
    n1_purple_empty_diamond, n1_purple_empty_oval, n1_purple_empty_squiggle,
    n1_purple_solid_diamond, n1_purple_solid_oval, n1_purple_solid_squiggle,
    n1_purple_striped_diamond, n1_purple_striped_oval, n1_purple_striped_squiggle,
    n1_red_empty_diamond, n1_red_empty_oval, n1_red_empty_squiggle, n1_red_solid_diamond,
    n1_red_solid_oval, n1_red_solid_squiggle, n1_red_striped_diamond, n1_red_striped_oval,
    n1_red_striped_squiggle, n2_green_empty_diamonds, n2_green_empty_ovals,
    n2_green_empty_squiggles, n2_green_solid_diamonds, n2_green_solid_ovals,
    n2_green_solid_squiggles, n2_green_striped_diamonds, n2_green_striped_ovals,
    n2_green_striped_squiggles, n2_purple_empty_diamonds, n2_purple_empty_ovals,
    n2_purple_empty_squiggles, n2_purple_solid_diamonds, n2_purple_solid_ovals,
    n2_purple_solid_squiggles, n2_purple_striped_diamonds, n2_purple_striped_ovals,
    n2_purple_striped_squiggles, n2_red_empty_diamonds, n2_red_empty_ovals,
    n2_red_empty_squiggles, n2_red_solid_diamonds, n2_red_solid_ovals, n2_red_solid_squiggles,
    n2_red_striped_diamonds, n2_red_striped_ovals, n2_red_striped_squiggles,
    n3_green_empty_diamonds, n3_green_empty_ovals, n3_green_empty_squiggles,
    n3_green_solid_diamonds, n3_green_solid_ovals, n3_green_solid_squiggles,
    n3_green_striped_diamonds, n3_green_striped_ovals, n3_green_striped_squiggles,
    n3_purple_empty_diamonds, n3_purple_empty_ovals, n3_purple_empty_squiggles,
    n3_purple_solid_diamonds, n3_purple_solid_ovals, n3_purple_solid_squiggles,
    n3_purple_striped_diamonds, n3_purple_striped_ovals, n3_purple_striped_squiggles,
    n3_red_empty_diamonds, n3_red_empty_ovals, n3_red_empty_squiggles, n3_red_solid_diamonds,
    n3_red_solid_ovals, n3_red_solid_squiggles, n3_red_striped_diamonds, n3_red_striped_ovals,
    n3_red_striped_squiggles}.
#sort number_value = {1, 2, 3}.
#sort colour_value = {green, purple, red}.
#sort shading_value = {empty, solid, striped}.
#sort shape_value = {diamond, oval, squiggle}.
#static number(card, number_value).
#static colour(card, colour_value).
#static shading(card, shading_value).
#static shape(card, shape_value).
#static of_kind(card, kind).

% A card is known by all four features.

%% a green card of number 1, shading empty and shape diamond is one green empty diamond
of_kind(S, n1_green_empty_diamond) if number(S, 1), colour(S, green), shading(S, empty), shape(S, diamond).

%% a green card of number 1, shading empty and shape oval is one green empty oval
of_kind(S, n1_green_empty_oval) if number(S, 1), colour(S, green), shading(S, empty), shape(S, oval).

%% a green card of number 1, shading empty and shape squiggle is one green empty squiggle
of_kind(S, n1_green_empty_squiggle) if number(S, 1), colour(S, green), shading(S, empty), shape(S, squiggle).

%% a green card of number 1, shading solid and shape diamond is one green solid diamond
of_kind(S, n1_green_solid_diamond) if number(S, 1), colour(S, green), shading(S, solid), shape(S, diamond).

%% a green card of number 1, shading solid and shape oval is one green solid oval
of_kind(S, n1_green_solid_oval) if number(S, 1), colour(S, green), shading(S, solid), shape(S, oval).

%% a green card of number 1, shading solid and shape squiggle is one green solid squiggle
of_kind(S, n1_green_solid_squiggle) if number(S, 1), colour(S, green), shading(S, solid), shape(S, squiggle).

%% a green card of number 1, shading striped and shape diamond is one green striped diamond
of_kind(S, n1_green_striped_diamond) if number(S, 1), colour(S, green), shading(S, striped), shape(S, diamond).

%% a green card of number 1, shading striped and shape oval is one green striped oval
of_kind(S, n1_green_striped_oval) if number(S, 1), colour(S, green), shading(S, striped), shape(S, oval).

%% a green card of number 1, shading striped and shape squiggle is one green striped squiggle
of_kind(S, n1_green_striped_squiggle) if number(S, 1), colour(S, green), shading(S, striped), shape(S, squiggle).

%% a purple card of number 1, shading empty and shape diamond is one purple empty diamond
of_kind(S, n1_purple_empty_diamond) if number(S, 1), colour(S, purple), shading(S, empty), shape(S, diamond).

%% a purple card of number 1, shading empty and shape oval is one purple empty oval
of_kind(S, n1_purple_empty_oval) if number(S, 1), colour(S, purple), shading(S, empty), shape(S, oval).

%% a purple card of number 1, shading empty and shape squiggle is one purple empty squiggle
of_kind(S, n1_purple_empty_squiggle) if number(S, 1), colour(S, purple), shading(S, empty), shape(S, squiggle).

%% a purple card of number 1, shading solid and shape diamond is one purple solid diamond
of_kind(S, n1_purple_solid_diamond) if number(S, 1), colour(S, purple), shading(S, solid), shape(S, diamond).

%% a purple card of number 1, shading solid and shape oval is one purple solid oval
of_kind(S, n1_purple_solid_oval) if number(S, 1), colour(S, purple), shading(S, solid), shape(S, oval).

%% a purple card of number 1, shading solid and shape squiggle is one purple solid squiggle
of_kind(S, n1_purple_solid_squiggle) if number(S, 1), colour(S, purple), shading(S, solid), shape(S, squiggle).

%% a purple card of number 1, shading striped and shape diamond is one purple striped diamond
of_kind(S, n1_purple_striped_diamond) if number(S, 1), colour(S, purple), shading(S, striped), shape(S, diamond).

%% a purple card of number 1, shading striped and shape oval is one purple striped oval
of_kind(S, n1_purple_striped_oval) if number(S, 1), colour(S, purple), shading(S, striped), shape(S, oval).

%% a purple card of number 1, shading striped and shape squiggle is one purple striped squiggle
of_kind(S, n1_purple_striped_squiggle) if number(S, 1), colour(S, purple), shading(S, striped), shape(S, squiggle).

%% a red card of number 1, shading empty and shape diamond is one red empty diamond
of_kind(S, n1_red_empty_diamond) if number(S, 1), colour(S, red), shading(S, empty), shape(S, diamond).

%% a red card of number 1, shading empty and shape oval is one red empty oval
of_kind(S, n1_red_empty_oval) if number(S, 1), colour(S, red), shading(S, empty), shape(S, oval).

%% a red card of number 1, shading empty and shape squiggle is one red empty squiggle
of_kind(S, n1_red_empty_squiggle) if number(S, 1), colour(S, red), shading(S, empty), shape(S, squiggle).

%% a red card of number 1, shading solid and shape diamond is one red solid diamond
of_kind(S, n1_red_solid_diamond) if number(S, 1), colour(S, red), shading(S, solid), shape(S, diamond).

%% a red card of number 1, shading solid and shape oval is one red solid oval
of_kind(S, n1_red_solid_oval) if number(S, 1), colour(S, red), shading(S, solid), shape(S, oval).

%% a red card of number 1, shading solid and shape squiggle is one red solid squiggle
of_kind(S, n1_red_solid_squiggle) if number(S, 1), colour(S, red), shading(S, solid), shape(S, squiggle).

%% a red card of number 1, shading striped and shape diamond is one red striped diamond
of_kind(S, n1_red_striped_diamond) if number(S, 1), colour(S, red), shading(S, striped), shape(S, diamond).

%% a red card of number 1, shading striped and shape oval is one red striped oval
of_kind(S, n1_red_striped_oval) if number(S, 1), colour(S, red), shading(S, striped), shape(S, oval).

%% a red card of number 1, shading striped and shape squiggle is one red striped squiggle
of_kind(S, n1_red_striped_squiggle) if number(S, 1), colour(S, red), shading(S, striped), shape(S, squiggle).

%% a green card of number 2, shading empty and shape diamond is two green empty diamonds
of_kind(S, n2_green_empty_diamonds) if number(S, 2), colour(S, green), shading(S, empty), shape(S, diamond).

%% a green card of number 2, shading empty and shape oval is two green empty ovals
of_kind(S, n2_green_empty_ovals) if number(S, 2), colour(S, green), shading(S, empty), shape(S, oval).

%% a green card of number 2, shading empty and shape squiggle is two green empty squiggles
of_kind(S, n2_green_empty_squiggles) if number(S, 2), colour(S, green), shading(S, empty), shape(S, squiggle).

%% a green card of number 2, shading solid and shape diamond is two green solid diamonds
of_kind(S, n2_green_solid_diamonds) if number(S, 2), colour(S, green), shading(S, solid), shape(S, diamond).

%% a green card of number 2, shading solid and shape oval is two green solid ovals
of_kind(S, n2_green_solid_ovals) if number(S, 2), colour(S, green), shading(S, solid), shape(S, oval).

%% a green card of number 2, shading solid and shape squiggle is two green solid squiggles
of_kind(S, n2_green_solid_squiggles) if number(S, 2), colour(S, green), shading(S, solid), shape(S, squiggle).

%% a green card of number 2, shading striped and shape diamond is two green striped diamonds
of_kind(S, n2_green_striped_diamonds) if number(S, 2), colour(S, green), shading(S, striped), shape(S, diamond).

%% a green card of number 2, shading striped and shape oval is two green striped ovals
of_kind(S, n2_green_striped_ovals) if number(S, 2), colour(S, green), shading(S, striped), shape(S, oval).

%% a green card of number 2, shading striped and shape squiggle is two green striped squiggles
of_kind(S, n2_green_striped_squiggles) if number(S, 2), colour(S, green), shading(S, striped), shape(S, squiggle).

%% a purple card of number 2, shading empty and shape diamond is two purple empty diamonds
of_kind(S, n2_purple_empty_diamonds) if number(S, 2), colour(S, purple), shading(S, empty), shape(S, diamond).

%% a purple card of number 2, shading empty and shape oval is two purple empty ovals
of_kind(S, n2_purple_empty_ovals) if number(S, 2), colour(S, purple), shading(S, empty), shape(S, oval).

%% a purple card of number 2, shading empty and shape squiggle is two purple empty squiggles
of_kind(S, n2_purple_empty_squiggles) if number(S, 2), colour(S, purple), shading(S, empty), shape(S, squiggle).

%% a purple card of number 2, shading solid and shape diamond is two purple solid diamonds
of_kind(S, n2_purple_solid_diamonds) if number(S, 2), colour(S, purple), shading(S, solid), shape(S, diamond).

%% a purple card of number 2, shading solid and shape oval is two purple solid ovals
of_kind(S, n2_purple_solid_ovals) if number(S, 2), colour(S, purple), shading(S, solid), shape(S, oval).

%% a purple card of number 2, shading solid and shape squiggle is two purple solid squiggles
of_kind(S, n2_purple_solid_squiggles) if number(S, 2), colour(S, purple), shading(S, solid), shape(S, squiggle).

%% a purple card of number 2, shading striped and shape diamond is two purple striped diamonds
of_kind(S, n2_purple_striped_diamonds) if number(S, 2), colour(S, purple), shading(S, striped), shape(S, diamond).

%% a purple card of number 2, shading striped and shape oval is two purple striped ovals
of_kind(S, n2_purple_striped_ovals) if number(S, 2), colour(S, purple), shading(S, striped), shape(S, oval).

%% a purple card of number 2, shading striped and shape squiggle is two purple striped squiggles
of_kind(S, n2_purple_striped_squiggles) if number(S, 2), colour(S, purple), shading(S, striped), shape(S, squiggle).

%% a red card of number 2, shading empty and shape diamond is two red empty diamonds
of_kind(S, n2_red_empty_diamonds) if number(S, 2), colour(S, red), shading(S, empty), shape(S, diamond).

%% a red card of number 2, shading empty and shape oval is two red empty ovals
of_kind(S, n2_red_empty_ovals) if number(S, 2), colour(S, red), shading(S, empty), shape(S, oval).

%% a red card of number 2, shading empty and shape squiggle is two red empty squiggles
of_kind(S, n2_red_empty_squiggles) if number(S, 2), colour(S, red), shading(S, empty), shape(S, squiggle).

%% a red card of number 2, shading solid and shape diamond is two red solid diamonds
of_kind(S, n2_red_solid_diamonds) if number(S, 2), colour(S, red), shading(S, solid), shape(S, diamond).

%% a red card of number 2, shading solid and shape oval is two red solid ovals
of_kind(S, n2_red_solid_ovals) if number(S, 2), colour(S, red), shading(S, solid), shape(S, oval).

%% a red card of number 2, shading solid and shape squiggle is two red solid squiggles
of_kind(S, n2_red_solid_squiggles) if number(S, 2), colour(S, red), shading(S, solid), shape(S, squiggle).

%% a red card of number 2, shading striped and shape diamond is two red striped diamonds
of_kind(S, n2_red_striped_diamonds) if number(S, 2), colour(S, red), shading(S, striped), shape(S, diamond).

%% a red card of number 2, shading striped and shape oval is two red striped ovals
of_kind(S, n2_red_striped_ovals) if number(S, 2), colour(S, red), shading(S, striped), shape(S, oval).

%% a red card of number 2, shading striped and shape squiggle is two red striped squiggles
of_kind(S, n2_red_striped_squiggles) if number(S, 2), colour(S, red), shading(S, striped), shape(S, squiggle).

%% a green card of number 3, shading empty and shape diamond is three green empty diamonds
of_kind(S, n3_green_empty_diamonds) if number(S, 3), colour(S, green), shading(S, empty), shape(S, diamond).

%% a green card of number 3, shading empty and shape oval is three green empty ovals
of_kind(S, n3_green_empty_ovals) if number(S, 3), colour(S, green), shading(S, empty), shape(S, oval).

%% a green card of number 3, shading empty and shape squiggle is three green empty squiggles
of_kind(S, n3_green_empty_squiggles) if number(S, 3), colour(S, green), shading(S, empty), shape(S, squiggle).

%% a green card of number 3, shading solid and shape diamond is three green solid diamonds
of_kind(S, n3_green_solid_diamonds) if number(S, 3), colour(S, green), shading(S, solid), shape(S, diamond).

%% a green card of number 3, shading solid and shape oval is three green solid ovals
of_kind(S, n3_green_solid_ovals) if number(S, 3), colour(S, green), shading(S, solid), shape(S, oval).

%% a green card of number 3, shading solid and shape squiggle is three green solid squiggles
of_kind(S, n3_green_solid_squiggles) if number(S, 3), colour(S, green), shading(S, solid), shape(S, squiggle).

%% a green card of number 3, shading striped and shape diamond is three green striped diamonds
of_kind(S, n3_green_striped_diamonds) if number(S, 3), colour(S, green), shading(S, striped), shape(S, diamond).

%% a green card of number 3, shading striped and shape oval is three green striped ovals
of_kind(S, n3_green_striped_ovals) if number(S, 3), colour(S, green), shading(S, striped), shape(S, oval).

%% a green card of number 3, shading striped and shape squiggle is three green striped squiggles
of_kind(S, n3_green_striped_squiggles) if number(S, 3), colour(S, green), shading(S, striped), shape(S, squiggle).

%% a purple card of number 3, shading empty and shape diamond is three purple empty diamonds
of_kind(S, n3_purple_empty_diamonds) if number(S, 3), colour(S, purple), shading(S, empty), shape(S, diamond).

%% a purple card of number 3, shading empty and shape oval is three purple empty ovals
of_kind(S, n3_purple_empty_ovals) if number(S, 3), colour(S, purple), shading(S, empty), shape(S, oval).

%% a purple card of number 3, shading empty and shape squiggle is three purple empty squiggles
of_kind(S, n3_purple_empty_squiggles) if number(S, 3), colour(S, purple), shading(S, empty), shape(S, squiggle).

%% a purple card of number 3, shading solid and shape diamond is three purple solid diamonds
of_kind(S, n3_purple_solid_diamonds) if number(S, 3), colour(S, purple), shading(S, solid), shape(S, diamond).

%% a purple card of number 3, shading solid and shape oval is three purple solid ovals
of_kind(S, n3_purple_solid_ovals) if number(S, 3), colour(S, purple), shading(S, solid), shape(S, oval).

%% a purple card of number 3, shading solid and shape squiggle is three purple solid squiggles
of_kind(S, n3_purple_solid_squiggles) if number(S, 3), colour(S, purple), shading(S, solid), shape(S, squiggle).

%% a purple card of number 3, shading striped and shape diamond is three purple striped diamonds
of_kind(S, n3_purple_striped_diamonds) if number(S, 3), colour(S, purple), shading(S, striped), shape(S, diamond).

%% a purple card of number 3, shading striped and shape oval is three purple striped ovals
of_kind(S, n3_purple_striped_ovals) if number(S, 3), colour(S, purple), shading(S, striped), shape(S, oval).

%% a purple card of number 3, shading striped and shape squiggle is three purple striped squiggles
of_kind(S, n3_purple_striped_squiggles) if number(S, 3), colour(S, purple), shading(S, striped), shape(S, squiggle).

%% a red card of number 3, shading empty and shape diamond is three red empty diamonds
of_kind(S, n3_red_empty_diamonds) if number(S, 3), colour(S, red), shading(S, empty), shape(S, diamond).

%% a red card of number 3, shading empty and shape oval is three red empty ovals
of_kind(S, n3_red_empty_ovals) if number(S, 3), colour(S, red), shading(S, empty), shape(S, oval).

%% a red card of number 3, shading empty and shape squiggle is three red empty squiggles
of_kind(S, n3_red_empty_squiggles) if number(S, 3), colour(S, red), shading(S, empty), shape(S, squiggle).

%% a red card of number 3, shading solid and shape diamond is three red solid diamonds
of_kind(S, n3_red_solid_diamonds) if number(S, 3), colour(S, red), shading(S, solid), shape(S, diamond).

%% a red card of number 3, shading solid and shape oval is three red solid ovals
of_kind(S, n3_red_solid_ovals) if number(S, 3), colour(S, red), shading(S, solid), shape(S, oval).

%% a red card of number 3, shading solid and shape squiggle is three red solid squiggles
of_kind(S, n3_red_solid_squiggles) if number(S, 3), colour(S, red), shading(S, solid), shape(S, squiggle).

%% a red card of number 3, shading striped and shape diamond is three red striped diamonds
of_kind(S, n3_red_striped_diamonds) if number(S, 3), colour(S, red), shading(S, striped), shape(S, diamond).

%% a red card of number 3, shading striped and shape oval is three red striped ovals
of_kind(S, n3_red_striped_ovals) if number(S, 3), colour(S, red), shading(S, striped), shape(S, oval).

%% a red card of number 3, shading striped and shape squiggle is three red striped squiggles
of_kind(S, n3_red_striped_squiggles) if number(S, 3), colour(S, red), shading(S, striped), shape(S, squiggle).
