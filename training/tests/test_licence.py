import unittest

from stdc_training.licence import licence_of


class LicenceTest(unittest.TestCase):
    def test_names_what_was_used(self):
        text = licence_of(["ccp_masked", "hololens", "rendered"])
        self.assertTrue(text.startswith("Trained on sources with permissive terms only: Clothing"), text)
        self.assertIn("HoloLens office (MIT)", text)
        self.assertNotIn("Leeds", text)

    def test_one_source_for_research_decides(self):
        for sources in (["hololens", "lspet_teacher"], ["kitchen"], None):
            self.assertTrue(licence_of(sources).startswith("Weights for research use only"), sources)

    def test_a_teacher_counts_as_what_it_has_seen(self):
        self.assertIn("7-Scenes (non-commercial)", licence_of(["hololens"], taught=True))

    def test_a_source_without_terms_is_refused(self):
        with self.assertRaisesRegex(ValueError, "somewhere"):
            licence_of(["somewhere_else"])
