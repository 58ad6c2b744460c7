"""The people of a dance: what the carriers of each bench meet, and who carries when."""
