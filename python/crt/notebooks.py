"""Scripts and scenes are shown live in notebooks: a picture that is rendered while they change."""

import html
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import weakref
from typing import IO, Any

from . import _arguments
from .errors import Error, Status
from .options import Path
from .scenes import Scene

# The server prints its address as soon as it listens.
_ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/#token=[0-9a-f]+")


class Live:
    """A Live shows a scene or a script as a picture that can be turned about and zoomed, in
    notebooks and at its `address` in a browser on this machine:

        view = crt.live(scene)
        view                                    # shows it
        scene.entities.append(crt.Sphere((0, 2, 0), 0.5))
        view.show(scene)                        # and shows what has become of it

    It is made by the program `crt studio`, which must be installed, and ends with the object.
    """

    def __init__(
        self,
        scene: Scene | Path,
        *,
        height: int = 480,
        whole_page: bool = False,
        port: int = 0,
        threads: int = 0,
        command: str = "crt",
    ) -> None:
        """Takes a scene, which is shown as it is now, a script as text, or the pathlib.Path of its
        file. `height` is that of the frame in pixels. `whole_page` shows the whole studio with its
        editor, and not the picture alone. `command` is the program crt. If it cannot serve the
        script it raises crt.Error."""
        if shutil.which(command) is None:
            raise Error(
                Status.UNSUPPORTED,
                f"live: there is no program {command!r}: it is in the Debian package crt, and the"
                " studio in crt-studio",
            )
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        if isinstance(scene, str) and "\n" not in scene and scene.strip().lower().endswith(".crt"):
            raise ValueError(
                f"live: {_arguments.shown(scene)} is a path, not the text of a script: use"
                f" crt.live(pathlib.Path({scene!r}))"
            )
        if isinstance(scene, os.PathLike):
            self._file = pathlib.Path(scene)
        elif isinstance(scene, (Scene, str)):
            self._folder = tempfile.TemporaryDirectory(prefix="crt-live-")
            self._file = pathlib.Path(self._folder.name, "scene.crt")
            try:
                self.show(scene)
            except BaseException:
                self._folder.cleanup()
                raise
        else:
            raise _arguments.refusal("live: scene", "a Scene, a text or a pathlib.Path", scene)
        self._height = _arguments.whole(height, "live: height")
        self._whole_page = whole_page
        number = _arguments.whole(threads, "live: threads")
        words = [command, "studio", str(self._file), "--embed", "--threads", str(number)]
        if port:
            words += ["--port", str(_arguments.whole(port, "live: port"))]
        with tempfile.TemporaryFile("w+") as errors:  # a pipe that nobody reads would fill up
            process = _started(words, errors)
            self._end = weakref.finalize(self, _end, process, self._folder)
            self._address = _address(process, errors, self._end)

    @property
    def address(self) -> str:
        """Is what shows the whole studio in a browser on this machine."""
        return self._address

    @property
    def script(self) -> str:
        """Is the text of the script. If it is changed, the picture follows within a second."""
        return self._file.read_text(encoding="utf-8")

    @script.setter
    def script(self, text: str) -> None:
        if not isinstance(text, str):
            raise _arguments.refusal("Live: script", "a text", text)
        # A reader never sees a part of it.
        part = self._file.with_name(f".{self._file.name}.new")
        part.write_text(text, encoding="utf-8")
        part.replace(self._file)

    def show(self, scene: Scene | str) -> None:
        """Shows a scene as it is now, or the text of a script, in the place of what it showed."""
        if not isinstance(scene, Scene):
            self.script = scene
            return
        before = _files_in(self._folder)
        scene.save_script(self._file)
        after = _files_in(self._folder)
        for file in before:  # those that were not written again belong to what was shown before
            if after.get(file) == before[file]:
                file.unlink()

    @property
    def is_running(self) -> bool:
        """Says whether it still serves the page."""
        return self._end.alive

    def close(self) -> None:
        """Ends the server. The picture stays in the notebook as it is, and answers no more."""
        self._end()

    def __enter__(self) -> "Live":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Live({self._address if self.is_running else 'ended'})"

    def _repr_mimebundle_(self, **kinds: Any) -> dict[str, str]:
        """Shows the page in a frame."""
        if not self.is_running:
            return {"text/plain": repr(self)}
        place = self._address if self._whole_page else f"{self._address}&only=view"
        frame = (
            f'<iframe src="{html.escape(place)}" width="100%" height="{self._height}"'
            ' style="border: 0" allow="clipboard-write"></iframe>'
        )
        return {"text/html": frame, "text/plain": repr(self)}


def _files_in(folder: "tempfile.TemporaryDirectory[str] | None") -> dict[pathlib.Path, int]:
    """Returns the files of a folder with their numbers, which are new if they are replaced."""
    if folder is None:
        return {}
    return {file: file.stat().st_ino for file in pathlib.Path(folder.name).glob("scene-*")}


def _started(words: list[str], errors: IO[str]) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        words,
        stdin=subprocess.PIPE,  # its end is that of the server, if this process is killed
        stdout=subprocess.PIPE,
        stderr=errors,
        text=True,
    )


def _address(process: "subprocess.Popen[str]", errors: IO[str], end: weakref.finalize) -> str:
    """Waits until the server listens, and returns where."""
    assert process.stdout is not None
    found = _ADDRESS.search(process.stdout.readline())
    if found:
        return found[0]
    end()
    errors.seek(0)
    why = errors.read().strip().removeprefix("crt: error: ")
    raise Error(Status.IO, f"live: {why or 'the studio has ended'}")


def _end(
    process: "subprocess.Popen[str]", folder: "tempfile.TemporaryDirectory[str] | None"
) -> None:
    assert process.stdin is not None and process.stdout is not None
    process.stdin.close()
    seconds = 5
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    process.stdout.close()
    if folder is not None:
        folder.cleanup()
