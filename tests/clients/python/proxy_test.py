"""Which proxy of the environment is between a client and its server: the same rule as in
tests/service/client/proxy_test.cc.
"""

import unittest

from albtpu.proxy import proxy_for


class Proxies(unittest.TestCase):
    def test_are_never_used_for_this_machine(self):
        proxies = dict.fromkeys(("grpc_proxy", "https_proxy", "http_proxy"), "http://p:1")
        for target in ("127.0.0.1:5", "127.8.9.1:5", "LocalHost:5", "[::1]:5", "ipv6:[::1]:5", "dns:///localhost:5",
                       "dns://8.8.8.8/localhost:5", "dns:127.0.0.1:5", "ipv4:127.0.0.1:5,127.0.0.2:5",
                       "[::ffff:127.0.0.1]:5", "unix:/run/x", "unix-abstract:x"):
            self.assertIsNone(proxy_for(target, proxies), target)
        for target in ("128.0.0.1:5", "lidar.example:5", "localhost.example:5", "[2001:db8::1]:5",
                       "dns:///lidar.example:5", "ipv4:127.0.0.1:5,10.0.0.1:5", "[::ffff:10.0.0.1]:5",
                       "unix7.example:5", "unix-host:5"):
            self.assertEqual(proxy_for(target, proxies), ("http://p:1", "grpc_proxy"), target)

    def test_are_those_of_the_first_variable_that_is_set(self):
        for variables, expected in (({}, None), ({"HTTP_PROXY": "http://p:1"}, None),
                                    ({"http_proxy": "http://p:1", "https_proxy": "http://q:2/"}, "http://q:2"),
                                    ({"http_proxy": "http://p:1", "grpc_proxy": ""}, None),
                                    ({"http_proxy": "socks5://p:1"}, None),
                                    ({"http_proxy": "http://me:se@cret@p:1"}, "http://p:1"),
                                    ({"http_proxy": "http://me:se/cret@p:1/"}, "http://p:1")):
            proxy = proxy_for("h:5", variables)
            self.assertEqual(proxy and proxy.url, expected, variables)

    def test_are_left_out_for_listed_hosts(self):
        for target, listed, left_out in (("lidar.example:5", "a, .example", True), ("lidar.example:5", "*", True),
                                         ("10.1.2.3:5", "10.0.0.0/8", True), ("[fd00::2]:5", "fd00::/8", True),
                                         ("lidar.example:5", "example.org,,", False),
                                         ("11.1.2.3:5", "10.0.0.0/8", False)):
            proxy = proxy_for(target, {"http_proxy": "http://p:1", "no_proxy": listed})
            self.assertEqual(proxy is None, left_out, (target, listed))
        self.assertIsNotNone(proxy_for("h:5", {"http_proxy": "http://p:1", "no_proxy": "h", "no_grpc_proxy": ""}))


if __name__ == "__main__":
    unittest.main(verbosity=2)
