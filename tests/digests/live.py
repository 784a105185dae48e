"""A service, a sender and a listener once through, in a network namespace of their own:
    live.py FORETOUCH SCENE AVATAR CLIP POSES
Leaves in the working folder what was heard (heard.jsonl), the service's journal
(journal.lcmlog), what it shows a browser (view.json) and its metrics (metrics.txt)."""
import signal
import subprocess
import sys
import urllib.request

URL = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304"
HTTP, VIEW = "127.0.0.1:9464", "127.0.0.1:9465"
PATIENCE_S = 60


def line_with(program, word):
    """Reads a program's lines up to one with this word; all of them."""
    seen = ""
    for line in program.stdout:
        seen += line
        if word in line:
            return seen
    raise SystemExit(f"{program.args[1]}: ended before it said {word!r}")


def fetch(address, path):
    with urllib.request.urlopen(f"http://{address}{path}", timeout=PATIENCE_S) as answer:
        with open(path.strip("/"), "wb") as file:
            file.write(answer.read())


def once_through(begin, publish, poses):
    service = begin("serve", "--log", "journal.lcmlog", "--http", HTTP, "--view", VIEW)
    line_with(service, "ready")
    listener = begin("listen", "--json", "--status", "--count", poses, "--timeout", str(PATIENCE_S))
    heard = line_with(listener, '"status"')  # from now on it hears the service's answers
    fetch(VIEW, "/view.json")
    publish()
    heard += listener.communicate(timeout=PATIENCE_S)[0]
    with open("heard.jsonl", "w", encoding="utf-8") as file:
        file.write(heard)
    fetch(HTTP, "/metrics")
    service.send_signal(signal.SIGTERM)
    service.communicate(timeout=PATIENCE_S)
    return listener.returncode or service.returncode


def main(foretouch, scene, avatar, clip, poses):
    begun = []

    def begin(command, *words):
        world = ["--scene", scene, "--avatar", avatar] if command == "serve" else []
        program = subprocess.Popen([foretouch, command, "--url", URL, *world, *words],
                                   stdout=subprocess.PIPE, text=True)
        begun.append(program)
        return program

    def publish():
        subprocess.run([foretouch, "publish", clip, "--avatar", avatar, "--rate", "10", "--url",
                        URL, "--speed", "8"], check=True, stdout=subprocess.DEVNULL)

    try:
        return once_through(begin, publish, poses)
    finally:
        for program in begun:
            program.kill()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
