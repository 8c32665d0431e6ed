# SPDX-License-Identifier: BSD-3-Clause
"""window_click.py COMMAND...: runs the ParaView window, and clicks all along its status bar, as somebody does who presses the abort button: from
when CACTUS_WINDOW_NOTES (see window_notes.py) tells of an optimiser until the window says that it has stopped. Clicks are taken only where the mouse
is at the progress bar, so that it rests there in between. Ends as the command does."""

import ctypes
import os
import subprocess
import sys
import threading
import time

X11 = ctypes.CDLL("libX11.so.6")
XTST = ctypes.CDLL("libXtst.so.6")
X11.XOpenDisplay.restype = ctypes.c_void_p
X11.XDefaultRootWindow.restype = ctypes.c_ulong


class Attributes(ctypes.Structure):
    """XWindowAttributes, of which the first numbers are of use here."""

    _fields_ = [("x", ctypes.c_int), ("y", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int), ("rest", ctypes.c_char * 256)]


def largest_window(display):
    root, parent, children, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
    X11.XQueryTree(display, ctypes.c_ulong(X11.XDefaultRootWindow(display)), ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children), ctypes.byref(count))
    windows = []
    for i in range(count.value):
        windows.append(Attributes())
        X11.XGetWindowAttributes(display, ctypes.c_ulong(children[i]), ctypes.byref(windows[-1]))
    return max(windows, key=lambda window: window.width * window.height)


def move(display, x, y):
    XTST.XTestFakeMotionEvent(display, -1, x, y, 0)


def click_along(display, window, has_stopped):
    y = window.y + window.height - 14
    for x in range(window.x + 8, window.x + window.width, 8):
        move(display, x, y)
        for is_press in (1, 0):
            XTST.XTestFakeButtonEvent(display, 1, is_press, 0)
    for part in range(1, 10):
        move(display, window.x + part * window.width // 10, y)
        X11.XFlush(display)
        if has_stopped.wait(0.2):
            move(display, 0, 0)
            X11.XFlush(display)
            return


def is_due():
    try:
        with open(os.environ["CACTUS_WINDOW_NOTES"], encoding="utf-8") as file:
            return "CapsuleOptimizer" in file.read()
    except FileNotFoundError:
        return False


def pass_on(output, has_stopped):
    for line in output:
        sys.stderr.write(line)
        if "stopped by the user" in line:
            has_stopped.set()


with subprocess.Popen(sys.argv[1:], stderr=subprocess.PIPE, text=True, errors="replace") as process:
    has_stopped = threading.Event()
    reader = threading.Thread(target=pass_on, args=(process.stderr, has_stopped))
    reader.start()
    while process.poll() is None and not is_due():
        time.sleep(0.1)
    display = ctypes.c_void_p(X11.XOpenDisplay(None))
    while process.poll() is None and not has_stopped.is_set():
        click_along(display, largest_window(display), has_stopped)
    process.wait()
    reader.join()
sys.exit(process.returncode)
