"""Random characters: the round animals, people and toys of cartoons, which game meshes lack."""

from __future__ import annotations

import numpy as np

from .anatomy.bipeds import biped
from .anatomy.bodies import bird, blob, fish, snake
from .anatomy.builder import CharacterBuilder
from .anatomy.quadrupeds import quadruped
from .models import Model

SOURCE = "creatures"


def creature(name: str, rng: np.random.Generator) -> Model:
    """An animal on four legs or two, a person, a seated toy, a bird, a fish, a snake or a blob,
    with random proportions, pose, face and clothes; its front to the viewer."""
    builder = CharacterBuilder(rng)
    kind = rng.random()
    if kind < 0.28:
        quadruped(builder)
    elif kind < 0.56:
        biped(builder)
    elif kind < 0.66:
        biped(builder, seated=True)
    elif kind < 0.78:
        bird(builder)
    elif kind < 0.85:
        fish(builder)
    elif kind < 0.91:
        snake(builder)
    else:
        blob(builder)
    if builder.chance(0.3):
        _rough(builder)
    return builder.model(name)


def _rough(builder: CharacterBuilder) -> None:
    """Add folds, dents and swellings to the skin, as wide as a wrinkle or a muscle."""
    pace = float(np.exp(builder.rng.uniform(np.log(4), np.log(22))))
    for _ in range(3):
        direction = builder.rng.normal(0, 1, 3)
        frequency = pace * builder.vary(1, 0.3) * direction / np.linalg.norm(direction)
        amplitude = builder.between(0.02, 0.09) / pace
        builder.body.wave(frequency, builder.between(0, 6), amplitude)
