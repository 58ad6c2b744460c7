"""Who counts as one client, directly and behind a proxy on this machine."""

import socket
from contextlib import suppress

import httpx
import pytest

from app.service.clients import one_client
from tests.support.job_service import ENDLESS
from tests.support.serving import serving

# Addresses of one client each: of one network, of IPv4 written within IPv6, or none.
SAME = [
    [f"2001:db8:0:1::{number:x}" for number in range(1, 100)],
    [
        "192.0.2.7",
        "::ffff:192.0.2.7",
        "::FFFF:c000:207",
        "64:ff9b::192.0.2.7",
        "2002:c000:207:5::1",
        "2002:c000:207:6::1",
    ],
    ["2001:0:4136:e378:8000:63bf:3fff:fdd2", "2001:0:4136:e379:8000:63bf:3fff:fdd2", "192.0.2.45"],
    ["fe80::1%eth0", "fe80::2%eth1", "fe80::3", '"fe80::4"'],
    ["unknown", "_hidden1", "_hidden2", "a" * 300, "%", "[2001:db8::1"],
]


@pytest.mark.parametrize("addresses", SAME, ids=[addresses[0] for addresses in SAME])
def test_addresses_of_one_network_and_ipv4_within_ipv6_are_one_client(addresses):
    assert len({one_client(address) for address in addresses}) == 1


def test_addresses_of_other_networks_are_other_clients():
    others = [addresses[0] for addresses in SAME] + [
        "2001:db8:0:2::1",
        "192.0.2.8",
        "64:ff9b::192.0.2.9",
        "2002:c000:20a::1",
    ]
    assert len({one_client(address) for address in others}) == len(others)


def has_ipv6():
    with suppress(OSError), socket.create_server(("::1", 0), family=socket.AF_INET6):
        return True
    return False


@pytest.mark.thorough
@pytest.mark.skipif(not has_ipv6(), reason="this machine has no IPv6")
def test_a_proxy_on_this_machine_names_its_clients_over_ipv4_and_ipv6_and_nobody_else_does(tmp_path):
    with serving(tmp_path / "log", workers=2, host="::", jobs_client_max=1) as service:
        port = service.address[1]

        def made(url, client, address=None):
            transport = httpx.HTTPTransport(local_address=address)
            with httpx.Client(transport=transport, timeout=60.0) as asking:
                answer = asking.post(f"{url}:{port}/jobs", json=ENDLESS, headers={"X-Forwarded-For": client})
                return answer.status_code

        assert [made("http://[::1]", f"2001:db8:0:{network}::1") for network in (1, 2, 1)] == [202, 202, 429]
        assert [made("http://127.0.0.1", f"2001:db8:0:{network}::2") for network in (3, 3, 1)] == [202, 429, 429]
        assert [made("http://127.0.0.1", f"192.0.2.{number}", "127.0.0.2") for number in (1, 2)] == [202, 429]
