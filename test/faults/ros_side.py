# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The ROS side of a test: a master, subscribers, and a simulated crane."""

import os
import pathlib
import socket
import struct
import sys
import threading
import time
import xmlrpc.client

import diagnostic_msgs.msg
import geometry_msgs.msg
import rosgraph_msgs.msg
import rospy
import sensor_msgs.msg
import tf2_msgs.msg

import trk_bridge.msg
from processes import Failure, Process, free_port, wait_for

_MASTER = pathlib.Path(__file__).resolve().parent.parent / "ros" / "master.py"


class Master:
    """A master whose address stays the same after a restart."""

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
    """The newest values of each status on /diagnostics."""

    def __init__(self):
        self._newest = {}
        self._lock = threading.Lock()
        self._subscriber = rospy.Subscriber("/diagnostics", diagnostic_msgs.msg.DiagnosticArray, self._on_message)

    def _on_message(self, message):
        with self._lock:
            for status in message.status:
                # A status without values is sent before the node has started.
                if status.values:
                    self._newest[status.name] = (status.message, {pair.key: pair.value for pair in status.values})

    def of(self, name):
        """(message, values) of the newest status with this name; None before the first."""
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
    """A subscriber of the params of one camera: `on_params(id, counter, values in the order of sets.FIELDS, stamp in s)`.

    It reads the bytes itself: rospy's own decoding is too slow for 16 cameras.
    """

    _HEADER = struct.Struct("<4x3I")  # seq, stamp, and the length of frame_id
    _PARAMS = struct.Struct("<IQI128x13d")  # id, counter, format, matrix, and what is in FIELDS

    def __init__(self, topic, on_params):
        self._on_params = on_params
        expected = trk_bridge.msg.CameraParams._slot_types
        assert expected == ["std_msgs/Header", "uint32", "uint64", "uint32", "float64[16]", *["float64"] * 13], expected
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._on_message, tcp_nodelay=True, buff_size=1 << 20)

    def _on_message(self, message):
        seconds, nanoseconds, length = self._HEADER.unpack_from(message._buff)
        camera, counter, _, *found = self._PARAMS.unpack_from(message._buff, self._HEADER.size + length)
        self._on_params(camera, counter, tuple(found), seconds + 1e-9 * nanoseconds)

    def is_connected(self):
        return self._subscriber.get_num_connections() > 0

    def close(self):
        self._subscriber.unregister()


class Crane:
    """A camera on tf, with its CameraInfo, at 50 Hz. Its x increases by 1 m each time; its clock is off by `offset`
    seconds. If simulated, this clock is also published on /clock, and nodes that start now use it."""

    def __init__(self, name, is_simulated):
        self.offset, self.at = 0, 0
        self._name = name
        self._is_simulated = is_simulated
        rospy.set_param("/use_sim_time", is_simulated)
        self._clock = rospy.Publisher("/clock", rosgraph_msgs.msg.Clock, queue_size=10) if is_simulated else None
        self._tf = rospy.Publisher("/tf", tf2_msgs.msg.TFMessage, queue_size=100)
        self._info = rospy.Publisher(f"/{name}/camera_info", sensor_msgs.msg.CameraInfo, queue_size=1, latch=True)
        self._info.publish(sensor_msgs.msg.CameraInfo(
            width=1920, height=1080, distortion_model="plumb_bob", D=[0] * 5,
            K=[2000, 0, 959.5, 0, 2000, 539.5, 0, 0, 1]))
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._move, daemon=True)
        self._thread.start()

    def stop(self):
        """Ends it. Returns how many poses were published."""
        self._ends.set()
        self._thread.join()
        rospy.set_param("/use_sim_time", False)
        for publisher in (self._clock, self._tf, self._info):
            if publisher:
                publisher.unregister()
        return self.at

    def _move(self):
        while not self._ends.wait(0.02):
            stamp = rospy.Time.from_sec(time.time() + self.offset)
            if self._clock:
                self._clock.publish(stamp)
            self.at += 1
            pose = geometry_msgs.msg.TransformStamped()
            pose.header.stamp, pose.header.frame_id, pose.child_frame_id = stamp, "studio", self._name
            pose.transform.translation.x, pose.transform.rotation.w = self.at, 1
            self._tf.publish([pose])
