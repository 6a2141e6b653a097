"""Rules about scenes of several things: what there is in a scene, how much of it, what not."""
