"""Engines of continuous collision detection on chains of rigid links, against a truth proven in ball arithmetic."""
