"""Clients as the limits know them: by their addresses."""

from __future__ import annotations

from functools import lru_cache
from ipaddress import IPv4Address, ip_address, ip_network

from fastapi import Request

# Number of first bits of an IPv6 address that a network of one client has.
IPV6_BITS = 64


def client_of(request: Request) -> str:
    """Address of the client, for its limits; a proxy on this machine gives it in X-Forwarded-For."""
    return one_client(request.client.host) if request.client else ""


@lru_cache(maxsize=1024)
def one_client(address: str) -> str:
    """The client at an address: of IPv6 the first 64 bits, because one machine has all addresses that follow.

    >>> one_client("192.0.2.7"), one_client("::ffff:192.0.2.7"), one_client("2001:db8::7:1")
    ('192.0.2.7', '192.0.2.7', '2001:db8::/64')
    """
    try:
        ip = ip_address(address.partition("%")[0])
    except ValueError:  # a proxy gave a name
        return address
    if isinstance(ip, IPv4Address):
        return str(ip)
    return str(ip.ipv4_mapped or ip_network((ip, IPV6_BITS), strict=False))
