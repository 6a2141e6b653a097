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
