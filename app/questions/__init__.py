"""The questions: what each is asked with, and what it answers."""
