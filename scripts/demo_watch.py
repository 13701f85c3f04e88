#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Prints one line per second about a camera that was received back from trk, and a summary at the end.

Also prints the difference from the crane: ros_to_trk publishes the tf time of every counter on `sent`, trk_to_ros the counter
of every pose on `params`. Exits with 1 if nothing arrived, or not all data of a camera (params, CameraInfo, tf, poses to
compare).
"""

import argparse
import collections
import math
import signal
import sys
import threading
import time
import xmlrpc.client

import diagnostic_msgs.msg
import rosgraph
import rospy
import sensor_msgs.msg
import tf2_msgs.msg
import tf2_ros

import trk_bridge.msg


def angle_between(one, other):
    """Degrees between two rotations, unit quaternions, exact for small angles, too."""
    dot = one.x * other.x + one.y * other.y + one.z * other.z + one.w * other.w
    sign = 1 if dot >= 0 else -1
    chord = math.hypot(one.x - sign * other.x, one.y - sign * other.y, one.z - sign * other.z, one.w - sign * other.w)
    return math.degrees(4 * math.asin(min(1.0, chord / 2)))


class Watch:
    """Data of the received camera and of the crane. The threads of rospy write it, the main thread reads it."""

    def __init__(self, camera, crane, crane_frame):
        self._lock = threading.Lock()
        self._camera = camera
        self._crane_frame = crane_frame
        self.params = None
        self.info = None
        self.transform = None
        self.count = 0
        self.lost = 0
        self.first = self.last = None
        self.diagnostics = {}
        self.compared = 0
        self.largest_mm = self.largest_deg = 0.0
        self._sent = collections.OrderedDict()  # counter -> tf time
        self._counters = collections.OrderedDict()  # stamp of the received pose -> counter
        self._transforms = collections.deque(maxlen=1000)  # not compared yet
        self._tf = tf2_ros.Buffer()
        self._tf_listener = tf2_ros.TransformListener(self._tf, queue_size=1000)
        params = trk_bridge.msg.CameraParams
        rospy.Subscriber(f"/{crane}/sent", params, self._on_sent, queue_size=1000)
        rospy.Subscriber(f"/{camera}/params", params, self._on_params, queue_size=1000)
        rospy.Subscriber(f"/{camera}/camera_info", sensor_msgs.msg.CameraInfo, self._on_info, queue_size=1000)
        rospy.Subscriber("/tf", tf2_msgs.msg.TFMessage, self._on_tf, queue_size=1000)
        rospy.Subscriber("/diagnostics", diagnostic_msgs.msg.DiagnosticArray, self._on_diagnostics, queue_size=10)

    @staticmethod
    def _keep(table, key, value):
        table[key] = value
        if len(table) > 1000:
            table.popitem(last=False)

    def _on_sent(self, message):
        with self._lock:
            self._keep(self._sent, message.counter, message.header.stamp)

    def _on_params(self, message):
        with self._lock:
            if self.params is not None:
                self.lost += max(0, message.counter - self.params.counter - 1)
            self.params = message
            self.count += 1
            self.last = message.header.stamp.to_sec()
            if self.first is None:
                self.first = self.last
            self._keep(self._counters, message.header.stamp, message.counter)

    def _on_info(self, message):
        with self._lock:
            self.info = message

    def _on_tf(self, message):
        for transform in message.transforms:
            if transform.child_frame_id == self._camera:
                with self._lock:
                    self.transform = transform
                    self._transforms.append(transform)

    def _on_diagnostics(self, message):
        for status in message.status:
            if status.name.endswith(f": {self._camera}"):
                with self._lock:
                    self.diagnostics = {value.key: value.value for value in status.values}

    def compare(self):
        """Compares the received poses whose counter and crane pose are known; the others wait."""
        with self._lock:
            waiting = collections.deque(maxlen=self._transforms.maxlen)
            for back in self._transforms:
                stamp = self._sent.get(self._counters.get(back.header.stamp))
                if stamp is None or not self._tf.can_transform(back.header.frame_id, self._crane_frame, stamp):
                    waiting.append(back)
                    continue
                crane = self._tf.lookup_transform(back.header.frame_id, self._crane_frame, stamp).transform
                a, b = crane.translation, back.transform.translation
                self.largest_mm = max(self.largest_mm, 1000 * math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)))
                self.largest_deg = max(self.largest_deg, angle_between(crane.rotation, back.transform.rotation))
                self.compared += 1
            self._transforms = waiting

    def rate(self):
        """Sets a second, by their stamps."""
        return (self.count - 1) / (self.last - self.first) if self.count > 1 and self.last > self.first else 0.0

    def line(self):
        with self._lock:
            if self.params is None:
                return f"{self._camera}: nothing yet"
            p = self.params
            text = f"{self._camera}: {self.rate():6.2f} Hz  counter {p.counter}  lost {self.lost}"
            if self.transform is not None:
                t = self.transform.transform.translation
                text += f"  at {t.x:7.3f} {t.y:7.3f} {t.z:6.3f} m"
            text += f"  pan {p.pan:7.2f} tilt {p.tilt:6.2f} roll {p.roll:5.2f}  f {p.fov:6.2f} mm"
            if self.info is not None:
                text += f"  {2 * math.degrees(math.atan(self.info.width / 2 / self.info.K[0])):5.1f} deg wide"
            if self.compared:
                text += f"  off by {self.largest_mm:.1e} mm {self.largest_deg:.1e} deg"
            return text

    def complete(self):
        with self._lock:
            return None not in (self.params, self.info, self.transform) and self.compared > 0

    def summary(self):
        with self._lock:
            out = ["", "summary", f"  received     {self.count} sets of parameters at {self.rate():.2f} Hz"]
            out.append(f"  lost         {self.lost} by the counters seen in ROS, "
                       f"{self.diagnostics.get('lost', 'unknown')} by the node's diagnostics")
            if self.transform is not None:
                t, r = self.transform.transform.translation, self.transform.transform.rotation
                out.append(f"  last pose    {self.transform.header.frame_id} -> {self.transform.child_frame_id}: "
                           f"{t.x:.4f} {t.y:.4f} {t.z:.4f} m, quaternion {r.x:.6f} {r.y:.6f} {r.z:.6f} {r.w:.6f}")
            if self.info is not None:
                i = self.info
                out.append(f"  CameraInfo   {i.width}x{i.height} {i.distortion_model} in {i.header.frame_id}")
                out.append(f"               K {' '.join(f'{v:.6g}' for v in i.K)}")
                out.append(f"               D {' '.join(f'{v:.6g}' for v in i.D)}")
            if self.compared:
                out.append(f"  largest difference between the crane and the received camera, of {self.compared} poses: "
                           f"{self.largest_mm:.2g} mm, {self.largest_deg:.2g} degrees")
            else:
                out.append("  no received pose could be compared with the crane")
            return "\n".join(out)


def wait_for_master(seconds):
    """rospy waits for a master without limit; this ends after `seconds` with an error."""
    deadline = time.monotonic() + seconds
    while True:
        try:
            xmlrpc.client.ServerProxy(rosgraph.get_master_uri()).getPid("/demo_watch")
            return
        except (OSError, xmlrpc.client.Error):
            if time.monotonic() > deadline:
                sys.exit(f"demo_watch: no ROS master within {seconds} s")
            time.sleep(0.1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--camera", required=True, help="name of the received camera, which is also its namespace and frame")
    parser.add_argument("--crane", required=True, help="namespace of the crane's ros_to_trk")
    parser.add_argument("--crane-frame", required=True, help="the crane's camera frame")
    parser.add_argument("--seconds", type=float, default=0, help="how long to watch after the first sample; 0: until Ctrl-C")
    parser.add_argument("--patience", type=float, default=30, help="how long to wait for the first sample")
    options = parser.parse_args()

    done = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: done.set())
    wait_for_master(options.patience)
    rospy.init_node("demo_watch", anonymous=True, disable_signals=True)
    watch = Watch(options.camera, options.crane, options.crane_frame)

    deadline = time.monotonic() + options.patience
    started = None
    while not done.wait(1.0):
        watch.compare()
        print(watch.line(), flush=True)
        now = time.monotonic()
        if started is None and watch.complete():
            started = now
        if started is None and now > deadline:
            print(f"demo_watch: params, camera_info, tf of {options.camera} and poses of {options.crane_frame} to compare "
                  f"them with have not all arrived within {options.patience:.0f} s", file=sys.stderr)
            break
        if started is not None and options.seconds and now - started >= options.seconds:
            break
    watch.compare()
    print(watch.summary(), flush=True)
    rospy.signal_shutdown("done")
    return 0 if watch.complete() else 1


if __name__ == "__main__":
    sys.exit(main())
