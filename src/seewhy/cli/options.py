"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

DomainName = Annotated[
    str, typer.Argument(metavar="DOMAIN", help="A bundled domain's name or a domain folder.")
]
ModelFolder = Annotated[
    Path, typer.Argument(metavar="MODEL", help="A model folder, made by 'seewhy train'.")
]
ImageFile = Annotated[Path, typer.Argument(metavar="IMAGE", help="A picture file.")]
DataFolder = Annotated[
    Path, typer.Option("--data", help="A dataset folder: pictures and scenes.csv.")
]
Outside = Annotated[
    bool,
    typer.Option("--outside", help="Also read pictures that lie outside of the dataset's folder."),
]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON.")]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Settles every random choice.")]

Speak = Annotated[bool, typer.Option("--speak", help="Also say the answer aloud.")]
SpeechFile = Annotated[
    Path | None,
    typer.Option("--speech", metavar="FILE.wav", help="Also write the spoken answer to this file."),
]

Eyes = Annotated[
    str | None,
    typer.Option(
        "--eyes",
        help="What sees: a backbone's name, or none for networks that grow (what the domain says; "
        "else the backbone that comes with SeeWhy, and none where drawings come before).",
    ),
]
Device = Annotated[
    str,
    typer.Option(
        "--device",
        help="Where it computes: cpu, cuda or mps; auto: on a graphics processor if there is one.",
    ),
]
Reading = Annotated[
    str | None,
    typer.Option(
        "--reading",
        help="How features are read: each its most probable value (argmax), together as fits the "
        "knowledge best (consistent), or so with a network of the class as a witness (with_class).",
    ),
]
Gate = Annotated[
    float | None,
    typer.Option(
        "--gate",
        help="Let the tree classify pictures of which a network is less sure than this; 0: none.",
    ),
]
KnownShare = Annotated[
    float | None,
    typer.Option(
        "--known-share",
        help="The share of pictures like those of training that is answered; 1: every picture is.",
    ),
]
Host = Annotated[
    str, typer.Option("--host", help="The address to listen at; 0.0.0.0: all of the machine.")
]
Port = Annotated[int, typer.Option("--port", min=0, max=65535, help="0: any that is free.")]
Token = Annotated[
    str | None,
    typer.Option(
        "--token",
        envvar="SEEWHY_TOKEN",
        help="What who asks has to send; made up where others than this machine may ask.",
    ),
]
AllowHost = Annotated[
    list[str] | None,
    typer.Option("--allow-host", help="A name by which the server is called, too."),
]
