"""Claims of certificates as kinds and values, and their sentences in English and Chinese."""
