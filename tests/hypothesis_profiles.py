"""How examples of properties are chosen: the same at every run, or random ones (`make hunt`)."""

from __future__ import annotations

from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

REPEATABLE = "repeatable"
"""The same examples at every run, so that what passed once does not fail by chance."""

RANDOM = "random"
"""Other examples at every run; what fails is kept in .hypothesis/ and tried first from then on."""


def register() -> None:
    """Register both profiles, and take the repeatable one where no other is asked for."""
    # A slow machine is no fault of what is tested.
    patient = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
    settings.register_profile(REPEATABLE, patient, derandomize=True, database=None)
    settings.register_profile(RANDOM, patient, derandomize=False, print_blob=True)
    settings.load_profile(REPEATABLE)
    _leave_out_constants_of_modules()


def _leave_out_constants_of_modules() -> None:
    """Let repeatable examples depend on nothing but the test.

    Hypothesis also draws numbers and texts that stand in modules of this project: examples would
    be others after any change of the source, and with other modules imported before. It has no
    option for that.
    """
    found = providers._get_local_constants
    none = providers.Constants()
    providers._get_local_constants = lambda: none if settings.default.derandomize else found()
