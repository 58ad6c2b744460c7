"""Clients as the limits know them: by their addresses."""

from __future__ import annotations

from functools import lru_cache
from ipaddress import IPv4Address, IPv6Address, IPv6Network, ip_address, ip_network

from fastapi import Request

# Number of first bits of an IPv6 address that a network of one client has.
IPV6_BITS = 64
# IPv6 addresses under which IPv4 clients come through a translator (RFC 6052): the IPv4 address is their last 32 bits.
TRANSLATED = IPv6Network("64:ff9b::/96")
# Longest address that is read, with the name of an interface behind it [characters].
ADDRESS_LENGTH = 64
# All clients of which a proxy says something else than an address, such as a name that may change with each request.
UNKNOWN = "unknown"


def client_of(request: Request) -> str:
    """Address of the client, for its limits; a proxy on this machine gives it in X-Forwarded-For."""
    return one_client(request.client.host[:ADDRESS_LENGTH]) if request.client else ""


@lru_cache(maxsize=1024)
def one_client(address: str) -> str:
    """The client at an address: of IPv6 the first 64 bits, because one machine has all addresses that follow.

    >>> one_client("192.0.2.7"), one_client("::ffff:192.0.2.7"), one_client("2001:db8::7:1")
    ('192.0.2.7', '192.0.2.7', '2001:db8::/64')
    """
    try:
        ip = ip_address(address.strip('"').partition("%")[0])
    except ValueError:
        return UNKNOWN
    if isinstance(ip, IPv6Address):
        ip = within(ip) or ip
    return str(ip if isinstance(ip, IPv4Address) else ip_network((ip, IPV6_BITS), strict=False))


def within(ip: IPv6Address) -> IPv4Address | None:
    """The IPv4 address of a client that is written within an IPv6 address: mapped, translated, 6to4 or Teredo."""
    if ip in TRANSLATED:
        return IPv4Address(int(ip) & 0xFFFF_FFFF)
    return ip.ipv4_mapped or ip.sixtofour or (ip.teredo[1] if ip.teredo else None)
