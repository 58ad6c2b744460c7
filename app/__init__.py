"""HTTP service, command line, tables and figures around core."""
