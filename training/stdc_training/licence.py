"""Terms of what a network was trained on, for the weights file."""

# The beginning of a source's name, who made it, its terms, and whether these permit every use.
TERMS = [
    ("ccp", "Clothing Co-Parsing", "repository Apache-2.0, photos of others", True),
    ("lspet", "Leeds Sports Pose Extended", "research; Flickr photos", False),
    ("voc", "PASCAL VOC 2012", "Flickr terms", False),
    ("human291", "Human-Segmentation-Dataset", "no terms stated", False),
    ("kitchen", "7-Scenes", "non-commercial", False),
    ("hololens", "HoloLens office", "MIT", True),
    ("corridor", "corridor", "MIT", True),
    ("rendered", "frames of STDC-SLAM's own renderer", "Apache-2.0", True),
]

# How the text begins where all of them do.
PERMISSIVE = "Trained on sources with permissive terms only"


def licence_of(sources, taught=False):
    """The text for a network trained on `sources`, a list of their names; None: all of them.
    `taught` by a network that may have seen all of them, it counts as trained on all."""
    used = [entry for entry in TERMS
            if sources is None or taught or any(s.startswith(entry[0]) for s in sources)]
    unknown = [s for s in sources or () if not any(s.startswith(entry[0]) for entry in TERMS)]
    if unknown:
        raise ValueError(f"no terms are known of {', '.join(unknown)}: add them to licence.py")
    listed = ", ".join(f"{name} ({terms})" for _, name, terms, _ in used)
    if all(permissive for *_, permissive in used):
        return f"{PERMISSIVE}: {listed}. See models/README.md."
    return f"Weights for research use only: trained on {listed}. See models/README.md."
