"""Jobs: calls whose answers are worked out later, and that a kill of any process does not lose.

The service writes a call down (store), the runner hands it to a process of its own (runner, work), and the answer
stays in the data folder until it is removed or too old. The service's processes see to it that there is one runner
while there is something to do (keeper).
"""
