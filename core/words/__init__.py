"""The sentences of answers, and the catalogue of each language but English.

`make words` brings the catalogues (gettext) up to date with the sentences of the code, and the build compiles them.
"""
