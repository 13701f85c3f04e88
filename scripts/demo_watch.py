#!/usr/bin/env python3
"""Prints a line a second of what a camera of trk_bridge sends into ROS, and a summary at the end.

Exits 1 when nothing, or not everything of a camera (params, CameraInfo, tf), arrived.
"""

import argparse
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

import trk_bridge.msg


class Watch:
    """What came of one camera. Callbacks of rospy's threads fill it, the main thread reads it."""

    def __init__(self, camera):
        self._lock = threading.Lock()
        self._camera = camera
        self.params = None
        self.info = None
        self.transform = None
        self.count = 0
        self.lost = 0
        self.first = self.last = None
        self.diagnostics = {}
        rospy.Subscriber(f"/{camera}/params", trk_bridge.msg.CameraParams, self._on_params, queue_size=1000)
        rospy.Subscriber(f"/{camera}/camera_info", sensor_msgs.msg.CameraInfo, self._on_info, queue_size=1000)
        rospy.Subscriber("/tf", tf2_msgs.msg.TFMessage, self._on_tf, queue_size=1000)
        rospy.Subscriber("/diagnostics", diagnostic_msgs.msg.DiagnosticArray, self._on_diagnostics, queue_size=10)

    def _on_params(self, message):
        with self._lock:
            if self.params is not None:
                self.lost += max(0, message.counter - self.params.counter - 1)
            self.params = message
            self.count += 1
            self.last = message.header.stamp.to_sec()
            if self.first is None:
                self.first = self.last

    def _on_info(self, message):
        with self._lock:
            self.info = message

    def _on_tf(self, message):
        for transform in message.transforms:
            if transform.child_frame_id == self._camera:
                with self._lock:
                    self.transform = transform

    def _on_diagnostics(self, message):
        for status in message.status:
            if status.name.endswith(f": {self._camera}"):
                with self._lock:
                    self.diagnostics = {value.key: value.value for value in status.values}

    def rate(self):
        """Sets a second, by their stamps."""
        return (self.count - 1) / (self.last - self.first) if self.count > 1 and self.last > self.first else 0.0

    def line(self):
        with self._lock:
            if self.params is None:
                return f"{self._camera}: nothing yet"
            p = self.params
            text = (
                f"{self._camera}: {self.rate():6.2f} Hz  counter {p.counter}  lost {self.lost}  "
                f"at {p.x:7.3f} {p.y:7.3f} {p.z:6.3f} m  pan {p.pan:7.2f} tilt {p.tilt:6.2f} roll {p.roll:5.2f}  "
                f"f {p.fov:6.2f} mm"
            )
            if self.info is not None:
                text += f"  {2 * math.degrees(math.atan(self.info.width / 2 / self.info.K[0])):5.1f} deg wide"
            return text

    def complete(self):
        with self._lock:
            return None not in (self.params, self.info, self.transform)

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
            return "\n".join(out)


def wait_for_master(seconds):
    """rospy waits for a master without end; this says after `seconds` that there is none."""
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
    parser.add_argument("--camera", required=True, help="name of the camera, which is also its namespace and frame")
    parser.add_argument("--seconds", type=float, default=0, help="how long to watch after the first sample; 0: until Ctrl-C")
    parser.add_argument("--patience", type=float, default=30, help="how long to wait for the first sample")
    options = parser.parse_args()

    done = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: done.set())
    wait_for_master(options.patience)
    rospy.init_node("demo_watch", anonymous=True, disable_signals=True)
    watch = Watch(options.camera)

    deadline = time.monotonic() + options.patience
    started = None
    while not done.wait(1.0):
        print(watch.line(), flush=True)
        now = time.monotonic()
        if started is None and watch.complete():
            started = now
        if started is None and now > deadline:
            print(f"demo_watch: params, camera_info and tf of {options.camera} have not all come within "
                  f"{options.patience:.0f} s", file=sys.stderr)
            break
        if started is not None and options.seconds and now - started >= options.seconds:
            break
    print(watch.summary(), flush=True)
    rospy.signal_shutdown("done")
    return 0 if watch.complete() else 1


if __name__ == "__main__":
    sys.exit(main())
