"""Pictures ray-cast with MuJoCo, without OpenGL or a display: what bundled sources share."""
