"""Maps: files of a square and a path, read and written as GeoJSON, KML and DXF."""
