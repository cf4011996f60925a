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

    def runs(self):
        """The processes of runs: children of those of designs."""
        return [pid for child in children(self.process.pid)
                for pid in children(child)]

    def processes(self):
        """Those of designs and of runs."""
        return children(self.process.pid) + self.runs()

    def wait_for_processes(self, count):
        wait_for_count(self.processes, count)

    def wait_for_runs(self, count):
        wait_for_count(self.runs, count)


def wait_for_count(list_of, count, seconds=20):
    """Until there are so many. Raises TimeoutError."""
    deadline = time.monotonic() + seconds
    while len(found := list_of()) != count:
        if time.monotonic() > deadline:
            raise TimeoutError(f"{len(found)} processes, not {count}")
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
