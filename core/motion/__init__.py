"""Places and speeds of handles and benches."""
