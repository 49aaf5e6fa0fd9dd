"""The server: what it serves, to whom, and what it refuses."""

from __future__ import annotations

import http.client
import json
import socket
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from typing import Any

import pytest

from levade.errors import LevadeError
from levade.viewer.server import TOKEN, Server


class App:
    """Says three things and takes what it is told, unless that is rude."""

    def __init__(self) -> None:
        self.taken: list[dict[str, Any]] = []
        self.closed = threading.Event()

    def events(self) -> Iterator[dict[str, Any] | None]:
        try:
            yield {"number": 1}
            yield None
            yield {"number": 2, "text": "ä\n\nb"}
        finally:
            self.closed.set()

    def command(self, message: dict[str, Any]) -> None:
        if message.get("say") == "rude":
            raise LevadeError("say: that was rude")
        self.taken.append(message)


@pytest.fixture
def app() -> App:
    return App()


@pytest.fixture
def server(app: App) -> Iterator[Server]:
    with Server(lambda: f"<p>{TOKEN}</p>", events=app.events, command=app.command) as server:
        yield server


def ask(
    server: Server, path: str, *, method: str = "GET", host: str | None = None, body: object = None, **headers: str
) -> tuple[int, str, http.client.HTTPMessage]:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=10)
    content = body if isinstance(body, (bytes, type(None))) else json.dumps(body).encode()
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    if host is not None:
        named["Host"] = host
    connection.request(method, path, body=content, headers=named)
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text, answer.headers


def test_it_listens_on_the_loopback_address_alone(server: Server) -> None:
    assert server.url == f"http://127.0.0.1:{server.port}/"
    assert not server.public
    for *_, address in socket.getaddrinfo(socket.gethostname(), server.port, socket.AF_INET, socket.SOCK_STREAM):
        if not str(address[0]).startswith("127."):
            with socket.socket(type=socket.SOCK_STREAM) as other:
                assert other.connect_ex(address[:2]) != 0


def test_the_page_carries_the_token(server: Server) -> None:
    status, text, headers = ask(server, "/")
    assert (status, text) == (200, f"<p>{server.token}</p>")
    assert len(server.token) >= 20
    assert headers["Content-Type"] == "text/html; charset=utf-8"
    assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert headers["Access-Control-Allow-Origin"] is None


def test_every_server_has_a_token_of_its_own(server: Server) -> None:
    with Server(lambda: "") as other:
        assert other.token != server.token
        assert other.port != server.port


@pytest.mark.parametrize("host", ["localhost", "localhost:1234", "127.0.0.1:80", "[::1]:9", "127.9.9.9"])
def test_names_of_this_machine(server: Server, host: str) -> None:
    assert ask(server, "/", host=host)[0] == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "localhost.evil.example", "127.0.0.1.evil.example:80", "10.0.0.1", "", "[", "0.0.0.0"]
)
def test_a_name_that_someone_made_resolve_to_this_machine_gets_nothing(server: Server, app: App, host: str) -> None:
    """DNS rebinding: the browser believes that the page is of another site."""
    token = {"X_Levade_Token": server.token}
    for status, text, _ in (
        ask(server, "/", host=host),
        ask(server, f"/events?token={server.token}", host=host),
        ask(server, "/command", method="POST", host=host, body={"say": "stop"}, **token),
    ):
        assert status == 403
        assert server.token not in text
    assert app.taken == []


def test_events_are_told_to_those_with_the_token(server: Server, app: App) -> None:
    status, text, headers = ask(server, f"/events?token={server.token}")
    assert (status, headers["Content-Type"]) == (200, "text/event-stream; charset=utf-8")
    first, sign_of_life, second, end = text.split("\n\n")
    assert json.loads(first.removeprefix("data: ")) == {"number": 1}
    assert sign_of_life == ": "
    assert json.loads(second.removeprefix("data: ")) == {"number": 2, "text": "ä\n\nb"}
    assert end == ""
    for path in ("/events", "/events?token=", "/events?token=wrong", f"/events?token={server.token}x"):
        assert ask(server, path)[0] == 403
    assert ask(server, "/events", X_Levade_Token=server.token)[0] == 403


def test_a_listener_that_goes_away_is_noticed(app: App) -> None:
    going = threading.Event()

    def endless() -> Iterator[dict[str, Any] | None]:
        try:
            while not going.wait(0.01):
                yield None
        finally:
            app.closed.set()

    with Server(lambda: "", events=endless) as server:
        connection = socket.create_connection(("127.0.0.1", server.port))
        connection.sendall(f"GET /events?token={server.token} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        assert connection.recv(100)
        connection.close()
        try:
            assert app.closed.wait(10)
        finally:
            going.set()


def test_commands_need_the_token(server: Server, app: App) -> None:
    message = {"say": "pause"}
    for headers in ({}, {"X_Levade_Token": "wrong"}, {"Cookie": server.token}, {"X_Levade_Token": "ä"}):
        assert ask(server, "/command", method="POST", body=message, **headers)[0] == 403
    assert ask(server, f"/command?token={server.token}", method="POST", body=message)[0] == 403
    assert app.taken == []
    assert ask(server, "/command", method="POST", body=message, X_Levade_Token=server.token)[0] == 200
    assert app.taken == [message]


@pytest.mark.parametrize("body", [b"", b"{", b"[1]", b"3", b"\xff\xfe", b'"text"', b"[" * 10_000])
def test_commands_that_are_none(server: Server, app: App, body: bytes) -> None:
    status, text, _ = ask(server, "/command", method="POST", body=body, X_Levade_Token=server.token)
    assert (status, text) == (400, "A command is a JSON object.\n")
    assert app.taken == []


@pytest.mark.parametrize("length", ["1000000000", "-1", "x"])
def test_commands_of_a_wrong_length(server: Server, length: str) -> None:
    token = {"X_Levade_Token": server.token, "Content_Length": length}
    assert ask(server, "/command", method="POST", body=b"{}", **token)[0] == 400


def test_a_command_that_is_refused_says_why(server: Server) -> None:
    status, text, _ = ask(server, "/command", method="POST", body={"say": "rude"}, X_Levade_Token=server.token)
    assert (status, text) == (400, "say: that was rude\n")


@pytest.mark.parametrize(("method", "path"), [("GET", "/x"), ("GET", "/../etc/passwd"), ("POST", "/"), ("PUT", "/")])
def test_what_is_not_there(server: Server, method: str, path: str) -> None:
    assert ask(server, path, method=method, body={}, X_Levade_Token=server.token)[0] in (404, 501)


def test_a_page_without_events_takes_no_commands() -> None:
    with Server(lambda: "page") as server:
        assert ask(server, "/")[:2] == (200, "page")
        assert ask(server, f"/events?token={server.token}")[0] == 404
        assert ask(server, "/command", method="POST", body={}, X_Levade_Token=server.token)[0] == 404


def test_where_others_can_reach_it_the_page_needs_the_token_too() -> None:
    with Server(lambda: f"page {TOKEN}", host="0.0.0.0") as server:
        assert server.public
        assert server.url == f"http://{socket.gethostname()}:{server.port}/?token={server.token}"
        assert ask(server, "/", host="machine.example")[0] == 403
        assert ask(server, "/?token=wrong")[0] == 403
        status, text, _ = ask(server, f"/?token={server.token}", host="machine.example")
        assert (status, text) == (200, f"page {server.token}")


def test_a_port_that_is_taken(server: Server) -> None:
    with pytest.raises(
        LevadeError, match=rf"127.0.0.1:{server.port}: cannot be listened at \(Address already in use\)"
    ):
        Server(lambda: "", port=server.port)


@pytest.mark.parametrize("host", ["no.such.host.invalid", "203.0.113.7"])
def test_an_address_that_is_not_of_this_machine(host: str) -> None:
    with pytest.raises(LevadeError, match=rf"{host}:0: cannot be listened at \(.+\); an address of this machine"):
        Server(lambda: "", host=host)


def test_after_the_end_nobody_answers() -> None:
    with Server(lambda: "page") as server:
        url = server.url
        assert urllib.request.urlopen(url, timeout=10).read() == b"page"
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(url, timeout=10)
