# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
# ctest-timeout: 200
"""Client and server: a bad value gets its message, a good one after it the result, and neither waits for the other for ever."""

import os
import socket
import subprocess
import sys
import time

from cactus_testing import CactusTestCase, main

LIMIT = 90  # seconds, for all that client and server do together; they need a few


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def client(port, folder):
    """What the client does, in a process of its own."""
    from paraview import servermanager, simple

    simple.Connect("127.0.0.1", port)
    from chain import Chain

    def field(stage, name):
        stage.UpdatePipeline()
        array = servermanager.Fetch(stage).GetFieldData().GetAbstractArray(name)
        return array.GetValue(0) if array else None

    chain = Chain(folder)
    view = simple.CreateRenderView()
    simple.Show(simple.OutputPort(chain.surface, 0), view)
    for stage, name, bad, pattern in chain.bad_values():
        good = getattr(stage, name)
        setattr(stage, name, bad)
        assert pattern in field(stage, "Error"), (name, bad)
        simple.Render(view)
        setattr(stage, name, good)
        simple.Render(view)
        assert field(stage, "Error") is None, (name, good)
        print("good again:", stage.SMProxy.GetXMLName(), flush=True)
    simple.Disconnect()


class Server(CactusTestCase):
    def start(self, command, name):
        log = open(os.path.join(self.folder, name), "w+")
        self.addCleanup(log.close)
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)

        def end():
            if process.poll() is None:
                process.kill()
            process.wait()

        self.addCleanup(end)
        return process, log

    def text(self, log):
        log.seek(0)
        return log.read()

    def test_a_good_value_after_a_bad_one(self):
        port = free_port()
        server, server_log = self.start(["pvserver", f"--server-port={port}"], "server")
        until = time.monotonic() + LIMIT
        while "Accepting connection" not in self.text(server_log):
            self.assertIsNone(server.poll(), self.text(server_log))
            self.assertLess(time.monotonic(), until, self.text(server_log))
            time.sleep(0.2)
        mine, client_log = self.start(["pvpython", __file__, str(port), self.folder], "client")
        try:
            self.assertEqual(mine.wait(until - time.monotonic()), 0, self.text(client_log))
        except subprocess.TimeoutExpired:
            self.fail("client and server wait for each other:\n" + self.text(client_log).replace("ERR|", "") + self.text(server_log).replace("ERR|", ""))
        self.assertEqual(self.text(client_log).count("good again"), 8)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        client(int(sys.argv[1]), sys.argv[2])
    else:
        main()
