#!/usr/bin/env python3
"""A word in Python: linear drag. SPDX-License-Identifier: GPL-3.0-or-later"""
import pmpipe


@pmpipe.stage
def drag(frame, rate: float, set: str = "matter"):
    """Adds linear friction: acc += -rate v, as the term drag. rate: friction per time [1/time]."""
    acc = frame.contributes(set, "acc", of="v", term="drag")
    acc -= rate * frame.reads(set, "v")


if __name__ == "__main__":
    drag.main()
