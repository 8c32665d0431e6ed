# SPDX-License-Identifier: BSD-3-Clause
"""window_click.py HOW COMMAND...: runs the ParaView window, and stops what it does from when CACTUS_WINDOW_NOTES (see window_notes.py) tells that
growth works until the window says that it has stopped. HOW is `stop`, by clicks all along its status bar, as somebody does who presses the abort button,
or `close`, by asking it to close, with the mouse where a window has the button for that. Clicks are taken only where the mouse is at the progress
bar, so that it rests there in between. Ends as the command does."""

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
WINDOW_IS_GONE = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda display, error: 0)  # where X11 would end this program
X11.XSetErrorHandler(WINDOW_IS_GONE)


class Attributes(ctypes.Structure):
    """XWindowAttributes, of which the first numbers are of use here."""

    _fields_ = [("x", ctypes.c_int), ("y", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int), ("between", ctypes.c_char * 76), ("map_state", ctypes.c_int),
                ("rest", ctypes.c_char * 256)]


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent, as large as any XEvent."""

    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("message_type", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5), ("rest", ctypes.c_char * 96)]


X11.XInternAtom.restype = ctypes.c_ulong


def largest_window(display):
    """Attributes and number of the window."""
    root, parent, children, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
    X11.XQueryTree(display, ctypes.c_ulong(X11.XDefaultRootWindow(display)), ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children), ctypes.byref(count))
    windows = []
    for i in range(count.value):
        windows.append((Attributes(), children[i]))
        X11.XGetWindowAttributes(display, ctypes.c_ulong(children[i]), ctypes.byref(windows[-1][0]))
    return max(windows, key=lambda window: window[0].width * window[0].height)


def move(display, x, y):
    XTST.XTestFakeMotionEvent(display, -1, x, y, 0)


def ask_to_close(display, window, number, has_stopped):
    move(display, window.x + window.width, window.y + window.height)  # the first place beyond its corner
    atoms = [X11.XInternAtom(display, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW")]
    event = ClientMessage(type=33, window=number, message_type=atoms[0], format=32)
    event.data[0] = atoms[1]
    X11.XSendEvent(display, ctypes.c_ulong(number), 0, ctypes.c_long(0), ctypes.byref(event))
    X11.XFlush(display)
    if has_stopped.wait(0.5):
        for _ in range(100):
            time.sleep(0.1)
            if X11.XGetWindowAttributes(display, ctypes.c_ulong(number), ctypes.byref(window)) == 0 or window.map_state == 0:
                print("the window is closed", file=sys.stderr)
                break


def click_along(display, window, number, has_stopped):
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
            return "FibreRadialGrowth works" in file.read()
    except FileNotFoundError:
        return False


def pass_on(output, has_stopped):
    for line in output:
        sys.stderr.write(line)
        if "stopped by the user" in line:
            has_stopped.set()


stop = {"stop": click_along, "close": ask_to_close}[sys.argv[1]]
with subprocess.Popen(sys.argv[2:], stderr=subprocess.PIPE, text=True, errors="replace") as process:
    has_stopped = threading.Event()
    reader = threading.Thread(target=pass_on, args=(process.stderr, has_stopped))
    reader.start()
    while process.poll() is None and not is_due():
        time.sleep(0.1)
    display = ctypes.c_void_p(X11.XOpenDisplay(None))
    while process.poll() is None and not has_stopped.is_set():
        stop(display, *largest_window(display), has_stopped)
    process.wait()
    reader.join()
sys.exit(process.returncode)
