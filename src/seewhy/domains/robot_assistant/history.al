% Where the robot begins.
observed loc(rob1, library) at 0.
