"""Serve a page on this machine to this machine, by the standard library's HTTP server.

    with Server(page, events=events, command=command) as server:
        print(server.url)

``GET /`` gives the page, ``GET /events`` a stream of JSON messages (server-sent events), ``POST /command`` takes one. Two rules
protect against other sites in the same browser. The host name in a request must be one of this machine's (no DNS rebinding).
Events and commands need a random token that only the page has (no cross-site requests). If the server listens to other
machines, the page needs the token, too: it is part of `Server.url`.
"""

from __future__ import annotations

import ipaddress
import json
import secrets
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from socketserver import TCPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

from levade.errors import LevadeError

LOOPBACK = "127.0.0.1"

TOKEN = "@@token@@"
"""Stands for the token in the text of the page."""

_LARGEST = 65536
"""Largest size of a command [bytes]."""

_PATIENCE = 10.0
"""Time limit for a client that neither reads nor writes [s]."""

_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline';"
    " img-src data: blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}


class Server:
    """Serves a page from its own threads. It is a context manager.

    Args:
        page: Returns the HTML, for each request. `TOKEN` in it becomes the token.
        events: Returns a new iterator of messages for each listener. None instead of a message means that there is nothing new.
        command: Takes a message. LevadeError refuses it.
        host: Address at which to listen.
        port: Port; 0 for a free one.

    Raises:
        LevadeError: If it cannot listen there.
    """

    def __init__(
        self,
        page: Callable[[], str],
        *,
        events: Callable[[], Iterator[dict[str, Any] | None]] | None = None,
        command: Callable[[dict[str, Any]], object] | None = None,
        host: str = LOOPBACK,
        port: int = 0,
    ) -> None:
        self.page, self.events, self.command = page, events, command
        self.token = secrets.token_urlsafe(18)
        try:
            family, *_, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
            self._http = _Listener(self, family, address)
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise LevadeError(
                f"{host}:{port}: cannot be listened at ({reason}); an address of this machine, and port 0 for a free one"
            ) from None
        self._host = host
        self._address = ipaddress.ip_address(str(self._http.server_address[0]).split("%")[0])
        self.public = not self._address.is_loopback
        self._thread = threading.Thread(target=self._http.serve_forever, args=(0.1,), name="levade-page", daemon=True)

    @property
    def port(self) -> int:
        """The port on which it listens."""
        return int(self._http.server_address[1])

    @property
    def url(self) -> str:
        """The page's address, with the token in it if other machines can reach it."""
        address = self._address
        name = (
            socket.gethostname() if address.is_unspecified else f"[{address}]" if address.version == 6 else f"{address}"
        )
        return f"http://{name}:{self.port}/" + (f"?token={self.token}" if self.public else "")

    def knows(self, host: str | None) -> bool:
        """Tell whether a Host header is valid.

        It must name this machine, unless the page is for other machines and protected by its token. Other names that resolve to
        the loopback address do not count, since anyone can make such a name.

        Args:
            host: Value of the header. None if the request has none.

        Returns:
            True if it is valid.
        """
        if self.public:
            return True
        try:
            name = urlsplit(f"//{host or ''}").hostname or ""
            return name in ("localhost", self._host.lower()) or ipaddress.ip_address(name).is_loopback
        except ValueError:
            return False

    def __enter__(self) -> Server:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._http.shutdown()
        self._http.server_close()


class _Listener(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, served: Server, family: socket.AddressFamily, address: Any) -> None:
        self.address_family = family
        self.served = served
        super().__init__(address[:2], _Handler)

    def server_bind(self) -> None:
        # the base class asks the network for the machine's full name, which may take seconds
        TCPServer.server_bind(self)
        self.server_name, self.server_port = str(self.server_address[0]), int(self.server_address[1])

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Ignore clients that disconnect early."""


class _Handler(BaseHTTPRequestHandler):
    timeout = _PATIENCE
    server_version, sys_version = "levade", ""

    @property
    def _server(self) -> Server:
        assert isinstance(self.server, _Listener)
        return self.server.served

    def do_GET(self) -> None:
        server = self._server
        path, _, query = self.path.partition("?")
        given = parse_qs(query).get("token", [""])[0]
        if not server.knows(self.headers.get("Host")):
            self._refuse(403, "This page is only served under this machine's own name.")
        elif path == "/" and server.public and not self._is_token(given):
            self._refuse(403, "The address of the page is the whole line that levade printed, token and all.")
        elif path == "/":
            self._send(200, "text/html", server.page().replace(TOKEN, server.token))
        elif path == "/events" and server.events is not None:
            if self._is_token(given):
                self._stream(server.events())
            else:
                self._refuse(403, "Events need the page's token.")
        elif path == "/favicon.ico":
            self._send(204, "image/x-icon", "")
        else:
            self._refuse(404, "There is nothing here.")

    def do_POST(self) -> None:
        server = self._server
        if not server.knows(self.headers.get("Host")) or not self._is_token(self.headers.get("X-Levade-Token", "")):
            self._refuse(403, "Commands need the page's token.")
            return
        if self.path != "/command" or server.command is None:
            self._refuse(404, "There is nothing here.")
            return
        try:
            length = int(self.headers.get("Content-Length", ""))
            if not 0 <= length <= _LARGEST:
                raise ValueError(length)
            content = json.loads(self.rfile.read(length))
            if not isinstance(content, dict):
                raise TypeError
        except (ValueError, TypeError, RecursionError):
            self._refuse(400, "A command is a JSON object.")
            return
        try:
            server.command(content)
        except LevadeError as error:
            self._refuse(400, str(error))
        else:
            self._send(200, "application/json", "{}")

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self._server.token.encode())

    def _stream(self, messages: Iterator[dict[str, Any] | None]) -> None:
        self._head(200, "text/event-stream")
        try:
            for message in messages:
                # a comment now and then tells whether there still is someone who listens
                line = ": \n\n" if message is None else f"data: {json.dumps(message, allow_nan=False)}\n\n"
                self.wfile.write(line.encode())
        except OSError:
            pass
        finally:
            close: Any = getattr(messages, "close", None)
            if close is not None:
                close()

    def _refuse(self, status: int, why: str) -> None:
        self._send(status, "text/plain", why + "\n")

    def _send(self, status: int, kind: str, text: str) -> None:
        content = text.encode()
        self._head(status, kind, len(content))
        with suppress(OSError):
            self.wfile.write(content)

    def _head(self, status: int, kind: str, length: int | None = None) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        if length is not None:
            self.send_header("Content-Length", str(length))
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        with suppress(OSError):
            self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        pass
