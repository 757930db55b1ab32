"""The session of one client."""

from __future__ import annotations

import secrets
from collections.abc import Hashable, Iterator
from dataclasses import dataclass, field, replace

from ..camera import Affine, hint_in_view
from ..hints import hint_frames
from ..pins import pins_of
from ..preview import Viewport, ViewRequest
from ..preview.shape import DrawingShape, HintSource, PinSource
from ..protocol import ErrorCode, GetNormals, GetOverlaps, GetPalette, GetRigs, error_message
from ..protocol.fields import Message
from ..scene import Depth, Scene
from ..timeline import is_keyed, scene_at

Question = GetPalette | GetOverlaps | GetRigs | GetNormals


@dataclass(frozen=True)
class FrameContent:
    """The content of a frame: its drawing and camera."""

    digest: str
    camera: Affine


@dataclass
class Session:
    """One client after its hello.

    Change its content by the methods, which also drop cached requests.

    Attributes:
        identity: routing identity. name: name of the session. minor: the client's minor version.
        frames: content of each frame. viewport: what the client shows.
        request: last request number. asked: drawings that need_frame has requested.
        questions: requests about a frame's drawing that wait for it.
        informed: drawings whose errors were sent.
    """

    identity: bytes
    name: str = field(default_factory=lambda: secrets.token_hex(16))
    minor: int = 0
    revision: int = 0
    scene: Scene | None = None
    frames: dict[int, FrameContent] = field(default_factory=dict)
    viewport: Viewport | None = None
    request: int = 0
    asked: set[str] = field(default_factory=set)
    questions: list[Question] = field(default_factory=list)
    informed: set[str] = field(default_factory=set)
    _requests: dict[int, ViewRequest] = field(default_factory=dict)
    _shapes: dict[str, DrawingShape] = field(default_factory=dict)

    def set_scene(self, revision: int, scene: Scene) -> None:
        """Replace the scene."""
        self.revision, self.scene = revision, scene
        self._requests.clear()
        self._shapes.clear()

    def look_at(self, viewport: Viewport | None) -> None:
        """Set or remove the viewport."""
        self.viewport = viewport
        self._requests.clear()

    def put_frame(self, frame: int, content: FrameContent) -> None:
        """Set the content of ``frame``."""
        before = self.frames.get(frame)
        if before is not None and before.digest != content.digest:
            self.asked.discard(before.digest)  # a client does not send what no frame shows
        self.frames[frame] = content
        self._frame_changed(frame)

    def drop_frame(self, frame: int) -> None:
        """Remove the content of ``frame``."""
        before = self.frames.pop(frame, None)
        if before is not None:
            self.asked.discard(before.digest)
        self.questions = [asked for asked in self.questions if asked.frame != frame]
        self._frame_changed(frame)

    def _frame_changed(self, frame: int) -> None:
        self._requests.pop(frame, None)
        pinned = self.scene is not None and bool(pins_of(self.scene))
        if self._shapes or pinned:  # hints and pins of this frame count for others
            self._shapes.clear()
            self._requests.clear()

    def view(self) -> ViewRequest | None:
        """The current view request; None without a viewport, or if its frame has no drawing."""
        return None if self.viewport is None else self._request_for(self.viewport)

    def ahead(self) -> Iterator[ViewRequest]:
        """View requests that may come next: other frames, nearest first, equal ones once."""
        viewport = self.viewport
        if viewport is None or self.scene is None or viewport.frame not in self.frames:
            return
        seen = {self.sight(viewport.frame)}
        for frame in sorted(self.frames, key=lambda n: (abs(n - viewport.frame), n)):
            if self.sight(frame) in seen:
                continue
            seen.add(self.sight(frame))
            request = self._request_for(replace(viewport, frame=frame, show="lit"))
            if request is not None:
                yield request

    def sight(self, frame: int) -> Hashable:
        """Equal for frames that look the same: by drawing, and by frame if the scene has keys."""
        digest = self.frames[frame].digest
        return (digest, frame) if self.scene is not None and is_keyed(self.scene) else digest

    def frame_showing(self, digest: str) -> int | None:
        """A frame that shows the drawing; preferably the one in the viewport."""
        seen = self.viewport and self.frames.get(self.viewport.frame)
        if self.viewport and seen and seen.digest == digest:
            return self.viewport.frame
        return next((n for n, content in self.frames.items() if content.digest == digest), None)

    def check_request(self, request: int) -> Message | None:
        """Accept a request number. Returns the error if it does not rise."""
        if request <= self.request:
            return error_message(ErrorCode.STALE_REQUEST, request=request)
        self.request = request
        return None

    def _request_for(self, viewport: Viewport) -> ViewRequest | None:
        """The cached request, with its computed results, while nothing of it changes."""
        content = self.frames.get(viewport.frame)
        if content is None:
            return None
        request = self._requests.get(viewport.frame)
        if request is None or request.viewport != viewport:
            scene = None if self.scene is None else scene_at(self.scene, viewport.frame)
            request = self._requests[viewport.frame] = ViewRequest(
                self.name,
                viewport,
                self.shape(viewport.frame),
                content.camera,
                self.revision,
                scene,
            )
        return request

    def shape(self, frame: int) -> DrawingShape:
        """The drawing of ``frame``, with what the artist says of its depth. It is the same for all
        frames that show the drawing."""
        digest = self.frames[frame].digest
        depth = Depth() if self.scene is None else self.scene.depth
        pins = self._pins(digest)
        if depth == Depth() and not pins:
            return DrawingShape(digest)
        if digest not in self._shapes:
            first = min(n for n, content in self.frames.items() if content.digest == digest)
            sources = tuple(
                HintSource(
                    self.frames[hinted].digest,
                    tuple(
                        hint_in_view(hint, self.frames[hinted].camera)
                        for hint in depth.drawn
                        if hint.frame == hinted
                    ),
                )
                for hinted in hint_frames(depth, first)
                if hinted in self.frames
            )
            self._shapes[digest] = DrawingShape(digest, depth.layers, depth.colours, sources, pins)
        return self._shapes[digest]

    def _pins(self, digest: str) -> tuple[PinSource, ...]:
        """What lights follow on the drawing ``digest``, from other drawings."""
        found = []
        for pin in () if self.scene is None else pins_of(self.scene):
            content = self.frames.get(pin.frame)
            if content is not None and content.digest != digest:
                a, b, c, d, e, f = content.camera
                place = a * pin.x + b * pin.y + c, d * pin.x + e * pin.y + f
                found.append(PinSource(pin, content.digest, place))
        return tuple(found)
