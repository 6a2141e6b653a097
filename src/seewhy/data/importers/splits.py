"""Which pictures are for training and which for tests."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from hashlib import sha256

from seewhy.data.importers.annotation import AnnotatedPicture, Notes


def with_splits(
    pictures: Sequence[AnnotatedPicture], test_share: float, notes: Notes
) -> list[AnnotatedPicture]:
    """Return pictures with the splits that SeeWhy has, which are train and test.

    A validation split becomes training where the source has a test split, and the test split
    else. Where a source has no splits, ``test_share`` of the pictures of every class are kept for
    tests; pictures of one group stay together.

    Examples
    --------
    >>> shown = [AnnotatedPicture("1.jpg", split="train"), AnnotatedPicture("2.jpg", split="test"),
    ...          AnnotatedPicture("3.jpg", split="validation")]
    >>> [picture.split for picture in with_splits(shown, 0.0, Notes())]
    ['train', 'test', 'train']
    """
    splits = Counter(picture.split for picture in pictures)
    if splits.keys() - {""}:
        if test_share:
            notes.add("the source has splits, --test-share is not used")
        if splits["validation"]:
            into = "train" if splits["test"] else "test"
            notes.add(
                f"the {splits['validation']:,} pictures of the validation split are marked {into}"
            )
            return [
                replace(picture, split=into) if picture.split == "validation" else picture
                for picture in pictures
            ]
        return list(pictures)
    return _divided(pictures, test_share) if test_share else list(pictures)


def _divided(pictures: Sequence[AnnotatedPicture], test_share: float) -> list[AnnotatedPicture]:
    """Pictures of which a share of every class is kept for tests; groups stay together.

    The order is by digests of names, so that it does not depend on what else there is.
    """
    members: dict[str, list[int]] = {}
    for number, picture in enumerate(pictures):
        members.setdefault(picture.group or f"\0{picture.file}", []).append(number)
    wanted = {
        label: test_share * count
        for label, count in Counter(picture.class_name for picture in pictures).items()
    }
    chosen: set[int] = set()
    for group in sorted(
        members, key=lambda name: sha256(name.encode(errors="surrogateescape")).digest()
    ):
        labels = Counter(pictures[number].class_name for number in members[group])
        # Taken where it fills more of what is wanted than it takes beyond that.
        if sum(min(count, wanted[label]) for label, count in labels.items()) * 2 > sum(
            labels.values()
        ):
            chosen.update(members[group])
            for label, count in labels.items():
                wanted[label] = max(0.0, wanted[label] - count)
    return [
        replace(picture, split="test" if number in chosen else "train")
        for number, picture in enumerate(pictures)
    ]


def _digest(name: str) -> bytes:
    return sha256(name.encode(errors="surrogateescape")).digest()
