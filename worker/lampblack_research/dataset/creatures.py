"""Figures made up by chance: the round animals, people and toys of cartoons, which meshes of games
lack."""

from __future__ import annotations

import numpy as np

from .anatomy.bipeds import biped
from .anatomy.bodies import bird, blob, fish, snake
from .anatomy.figure import Figure
from .anatomy.quadrupeds import quadruped
from .models import Model

SOURCE = "creatures"


def creature(name: str, rng: np.random.Generator) -> Model:
    """An animal on four legs or two, a person, a seated toy, a bird, a fish, a snake or a blob,
    its proportions, pose, face and dress by chance, its front to the viewer."""
    figure = Figure(rng)
    kind = rng.random()
    if kind < 0.28:
        quadruped(figure)
    elif kind < 0.56:
        biped(figure)
    elif kind < 0.66:
        biped(figure, seated=True)
    elif kind < 0.78:
        bird(figure)
    elif kind < 0.85:
        fish(figure)
    elif kind < 0.91:
        snake(figure)
    else:
        blob(figure)
    if figure.some(0.3):
        _rough(figure)
    return figure.model(name)


def _rough(figure: Figure) -> None:
    """Folds, dents and swellings of the skin, a wrinkle's width or a muscle's."""
    pace = float(np.exp(figure.rng.uniform(np.log(4), np.log(22))))
    for _ in range(3):
        direction = figure.rng.normal(0, 1, 3)
        frequency = pace * figure.vary(1, 0.3) * direction / np.linalg.norm(direction)
        amplitude = figure.between(0.02, 0.09) / pace
        figure.body.wave(frequency, figure.between(0, 6), amplitude)
