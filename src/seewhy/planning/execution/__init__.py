"""Carrying out: sense, diagnose, plan, act and monitor, in a simulated world."""
