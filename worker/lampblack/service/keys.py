"""Keys for a worker on another machine: CURVE, the encryption of ZeroMQ.

Each side has a pair: a public key, which is given to the other side, and a secret one, which never
leaves its machine. What is sent is encrypted, and both sides know whom they talk to.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import zmq
import zmq.auth
from zmq.auth.thread import ThreadAuthenticator

from ..errors import LampblackError, OutputError
from ..files import read_bounded, understood

MAX_KEY_BYTES = 10_000
MAX_ADMITTED = 1000

Socket = zmq.Socket[bytes]


@dataclass(frozen=True)
class KeyPair:
    """A public and a secret key, 40 characters of Z85 each."""

    public: bytes
    secret: bytes


def make_keys(folder: Path, name: str) -> tuple[Path, Path]:
    """Write a new pair, ``name.key`` and ``name.key_secret``; only this user can read the secret.

    Returns:
        The files of the public and the secret key.

    Raises:
        LampblackError: ``name`` is no plain name. OutputError: a file is there already, or cannot
            be written.
    """
    if not name or Path(name).name != name or name.startswith("."):
        raise LampblackError(f"{name!r} cannot be the name of a key.", "Choose a plain word.")
    public, secret = folder / f"{name}.key", folder / f"{name}.key_secret"
    for path in (public, secret):
        if path.exists():
            raise OutputError(f"{path} is there already.", "Choose another name or folder.")
    before = os.umask(0o077)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        zmq.auth.create_certificates(folder, name)
    except OSError as error:
        raise OutputError(
            "The keys cannot be written.", "Choose another folder.", str(error)
        ) from error
    finally:
        os.umask(before)
    return public, secret


def read_keys(path: Path) -> KeyPair:
    """The pair in a file of a secret key.

    Raises:
        LampblackError: there is no such file, or it holds no secret key.
    """
    unusable = LampblackError(
        f"{path} is no secret key.", "Name a file .key_secret that `lampblack key` has made."
    )
    with understood(unusable):
        read_bounded(path, MAX_KEY_BYTES)
        public, secret = zmq.auth.load_certificate(path)
    if not public or not secret:
        raise unusable
    return KeyPair(public, secret)


def read_public_key(path: Path) -> bytes:
    """The public key in a file of either kind.

    Raises:
        LampblackError: there is no such file, or it holds no key.
    """
    unusable = LampblackError(
        f"{path} is no key.", "Name a file .key that `lampblack key` has made."
    )
    with understood(unusable):
        read_bounded(path, MAX_KEY_BYTES)
        public, _ = zmq.auth.load_certificate(path)
    return public


@contextmanager
def only_admitted(context: zmq.Context[Socket], folder: Path) -> Iterator[None]:
    """In this block, sockets of ``context`` with CURVE let in only clients whose public keys are in
    ``folder``. Others are refused before any message of theirs is read.

    Raises:
        LampblackError: there is no key in the folder, or more than 1000.
    """
    keys = [read_public_key(path) for path in sorted(folder.glob("*.key"))[: MAX_ADMITTED + 1]]
    if not 0 < len(keys) <= MAX_ADMITTED:
        raise LampblackError(
            f"{folder} holds {'no' if not keys else 'too many'} public keys (.key).",
            "Put the public key of each artist there.",
        )
    authenticator = ThreadAuthenticator(context)
    authenticator.start()
    try:
        authenticator.configure_curve(domain="*", location=folder)
        yield
    finally:
        authenticator.stop()
