"""Jobs: calls that are answered later and survive a kill of any process.

The service writes a call down (store), the runner hands it to a process of its own (runner, work), and the answer
stays in the data folder until it is removed or too old. The service's processes see to it that there is one runner
while there is something to do (keeper).
"""
