"""The memory that a burst of calls takes is given back afterwards, every time."""

import concurrent.futures

import albtpu
import faults
import programs
import serving

CALLERS, PULSES = 16, 500_000
BURSTS = 3
# The largest share of a burst's memory that may remain after it.
SHARE_LEFT = 0.2


class Memory(faults.FaultTest):
    def setUp(self):
        super().setUp()
        self.many = faults.random_pulses(PULSES)

    def query_all(self, server):
        with albtpu.connect(server.address, patience=serving.PATIENCE) as service:
            return service.query(**self.many).thu.size

    def test_is_given_back_after_each_burst(self):
        server = self.serve()
        with albtpu.connect(server.address) as service:
            self.assert_answers(service)
        before = faults.memory(server.process)
        with concurrent.futures.ThreadPoolExecutor(CALLERS) as callers:
            for burst in range(BURSTS):
                answered = list(callers.map(self.query_all, [server] * CALLERS))
                self.assertEqual(answered, [PULSES] * CALLERS)
                took = faults.memory(server.process, "VmHWM") - before
                faults.wait_until(lambda: faults.memory(server.process) - before < SHARE_LEFT * took,
                                  "the memory is given back")
                print(f"burst {burst + 1}: {took / 2**20:.0f} MiB more than before, then "
                      f"{(faults.memory(server.process) - before) / 2**20:.0f}")
        self.assert_drains(server)


if __name__ == "__main__":
    programs.main()
