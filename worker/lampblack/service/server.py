"""The main loop between socket and service."""

from __future__ import annotations

from collections.abc import Callable

from ..protocol import ErrorCode, ProtocolError, answer_to, decode, error_message
from .handlers import handle
from .service import Service
from .socket import RouterSocket


class Server:
    """Serves in the thread that calls ``run``. It ends the service's threads, but does not close
    the socket."""

    def __init__(self, socket: RouterSocket, service: Service) -> None:
        self._socket = socket
        self._service = service

    def run(self, gone: Callable[[], bool] = lambda: False, watched: int | None = None) -> None:
        """Serve until ``gone`` returns True.

        Args:
            gone: called in every iteration.
            watched: descriptor that becomes readable when ``gone`` may have changed.
        """
        self._service.start()
        try:
            while not gone():
                self._socket.wait(self._service.patience, watched)
                for identity, frames in self._socket.messages():
                    self._receive(identity, frames)
                for event in self._socket.events():
                    event()
                self._service.turn()
                self._flush()
        finally:
            self._service.say_goodbye()
            self._socket.flush()
            self._service.close()

    def _receive(self, identity: bytes, frames: list[bytes]) -> None:
        try:
            handle(self._service, identity, decode(frames, "client"))
        except ProtocolError as error:
            self._service.answer(identity, answer_to(error))
        except Exception as error:  # an error of one message must not affect the others
            details = repr(error)
            self._service.answer(identity, error_message(ErrorCode.INTERNAL, details=details))

    def _flush(self) -> None:
        for identity in self._socket.flush():
            session = self._service.sessions.get(identity)
            if session is not None:
                self._service.part_with(session)
