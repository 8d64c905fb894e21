"""Training of the STDC networks that find people: data, networks, losses, export and scores."""
