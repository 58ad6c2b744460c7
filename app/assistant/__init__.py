"""A door for assistants: the calls of the service as tools of the Model Context Protocol (MCP)."""
