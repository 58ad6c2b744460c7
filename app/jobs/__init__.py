"""Jobs: calls that are answered later and survive the death of any process.

The service stores a call (store), the runner starts a process for it (runner, work), and the answer stays in the data
folder until it is removed or too old. While there is work, the service's processes keep exactly one runner alive
(keeper).
"""
