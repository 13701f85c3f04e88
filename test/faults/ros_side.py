"""What a test has of ROS: a master, a subscriber of everything, and nodes."""

import os
import pathlib
import socket
import sys
import threading
import xmlrpc.client

import diagnostic_msgs.msg
import rospy

import trk_bridge.msg
from processes import Failure, Process, free_port, wait_for

_MASTER = pathlib.Path(__file__).resolve().parent.parent / "ros" / "master.py"


class Master:
    """A master at an address that stays when it is started again."""

    def __init__(self, folder):
        self._log = folder / "master.log"
        port = free_port(socket.SOCK_STREAM)
        self.uri = os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
        self._command = [sys.executable, "-B", _MASTER, port]
        self.start()

    def start(self):
        self._process = Process(self._command, self._log)
        wait_for(self._answers, "the master answers")

    def kill(self):
        self._process.kill()

    def _answers(self):
        try:
            return xmlrpc.client.ServerProxy(self.uri).getPid("/faults")[0] == 1
        except OSError:
            return False


class Diagnostics:
    """The newest values of every status on /diagnostics."""

    def __init__(self):
        self._newest = {}
        self._lock = threading.Lock()
        self._subscriber = rospy.Subscriber("/diagnostics", diagnostic_msgs.msg.DiagnosticArray, self._on_message)

    def _on_message(self, message):
        with self._lock:
            for status in message.status:
                # Without values a node has not begun.
                if status.values:
                    self._newest[status.name] = (status.message, {pair.key: pair.value for pair in status.values})

    def of(self, name):
        """(message, values) of the newest status with this name; none before it came."""
        with self._lock:
            return self._newest.get(name.lstrip("/"))

    def forget(self, name):
        with self._lock:
            self._newest.pop(name.lstrip("/"), None)

    def close(self):
        self._subscriber.unregister()

    def wait(self, name, condition, what):
        """The first values for which `condition(message, values)` is true."""
        def met():
            found = self.of(name)
            return found[1] if found and condition(*found) else None

        try:
            return wait_for(met, what)
        except Failure as failure:
            raise Failure(f"{failure}; {name} reports {self.of(name)}") from None


class Listener:
    """A subscriber of the params of one camera."""

    def __init__(self, topic, on_message):
        self._subscriber = rospy.Subscriber(topic, trk_bridge.msg.CameraParams, on_message, tcp_nodelay=True,
                                            buff_size=1 << 20)

    def is_connected(self):
        return self._subscriber.get_num_connections() > 0

    def close(self):
        self._subscriber.unregister()
