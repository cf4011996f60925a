"""A server of lamina's that runs: its memory, its processes."""

import os
import time


class ServerProcess:
    """To be derived from: `self.process` is the server's subprocess.Popen."""

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def memory(self):
        """The most that the server itself has taken [MB]."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as file:
            return next(int(line.split()[1]) / 1024 for line in file
                        if line.startswith("VmHWM"))

    def processes(self):
        """The server's children and theirs."""
        own = children(self.process.pid)
        return own + [pid for child in own for pid in children(child)]

    def wait_for_processes(self, count, seconds=20):
        """Until there are so many. Raises TimeoutError."""
        deadline = time.monotonic() + seconds
        while len(self.processes()) != count:
            if time.monotonic() > deadline:
                raise TimeoutError(f"{len(self.processes())} processes")
            time.sleep(0.02)


def children(pid):
    found = []
    path = f"/proc/{pid}/task"
    try:
        for thread in os.listdir(path):
            with open(f"{path}/{thread}/children", encoding="ascii") as file:
                found += map(int, file.read().split())
    except (FileNotFoundError, ProcessLookupError):
        pass  # it has just ended
    return found
