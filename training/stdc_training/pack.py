"""Pack the photos once: python3 -m stdc_training.pack PEOPLE FOLDER [--long-side 320]."""

import argparse

from . import people


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("people", help="folder with the kinds of photos (ccp_masked, ...)")
    parser.add_argument("folder", help="where the packed files go")
    parser.add_argument("--long-side", type=int, default=320, help="larger images are shrunk to it")
    parser.add_argument("--only", choices=("train", "validation"), help="pack one set only")
    parser.add_argument("--choose-validation", action="store_true",
                        help="write validation.txt anew instead of reading it")
    options = parser.parse_args()
    if options.choose_validation:
        lines = ["# Images that are never trained on: kind/name."]
        lines += ["/".join(item) for item in people.choose_validation(options.people)]
        people.VALIDATION_LIST.write_text("\n".join(lines) + "\n")
    held_out = people.read_validation()
    items = people.list_images(options.people)
    sets = {"train": [item for item in items if item not in held_out],
            "validation": [item for item in items if item in held_out]}
    for name, chosen in sets.items():
        if options.only in (None, name):
            people.pack(options.people, options.folder, chosen, name, options.long_side)
            print(f"{name}: {len(chosen)} images")


if __name__ == "__main__":
    main()
