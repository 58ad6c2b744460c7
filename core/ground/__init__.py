"""The ground that benches sweep: over which places each of them goes, and polygons that hold all of it."""
