"""The ground that benches sweep: the places that each of them passes, and polygons that hold all of the ground."""
