"""The things of a table as bodies in MuJoCo."""

from __future__ import annotations

import math

import mujoco

from seewhy_lab.simulators.tabletop.table import Table, TableThing

__all__ = ["build_model"]

_FORMS = {"cube": "box", "sphere": "sphere", "cylinder": "cylinder"}
_STEP = 0.003


def build_model(table: Table) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The things as they stand; geom 0 is the table, and thing number n is geom n + 1, group n."""
    bodies = "".join(_body(number, thing) for number, thing in enumerate(table.things))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{_STEP}" integrator="implicitfast" iterations="30"/>'
        '<default><geom density="650" friction="0.55 0.002 0.0001" condim="6" '
        'solref="0.008 1"/></default>'
        f'<worldbody><geom type="plane" size="0 0 1"/>{bodies}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def _body(number: int, thing: TableThing) -> str:
    width, height = thing.half
    size = f"{width:.9f} {height:.9f}" if thing.shape == "cylinder" else f"{width:.9f}"
    if thing.shape == "cube":
        size = f"{width:.9f} {width:.9f} {height:.9f}"
    turn = f"{math.cos(thing.yaw / 2.0):.9f} 0 0 {math.sin(thing.yaw / 2.0):.9f}"
    return (
        f'<body pos="{thing.x:.9f} {thing.y:.9f} {thing.z:.9f}" quat="{turn}"><freejoint/>'
        f'<geom type="{_FORMS[thing.shape]}" size="{size}" group="{number}"/></body>'
    )
