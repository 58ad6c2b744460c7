"""Maps: files with a square and a path, read and written as GeoJSON, KML and DXF."""
