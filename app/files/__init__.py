"""Tables, workbooks and figures, and files on the disk."""
