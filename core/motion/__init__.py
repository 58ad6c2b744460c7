"""Where handles and benches are, and how fast."""
