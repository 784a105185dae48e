"""What may differ between two runs is masked, and the least other difference is not."""
import struct
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

import digests  # noqa: E402
import normalise  # noqa: E402

RESULTS = (b'{"format":"foretouch-results","version":1,"tool":"0.1.0","rate":10}\n'
           b'{"step":0,"contacts":[{"verdict":"contact","toi":0.4128}],"latency_us":3.1}\n')
PAGE = (b'<script type="application/json" id="foretouch-view">{"tool":"foretouch 0.1.0",'
        b'"title":"a b","summary":[{"name":"latency","value":"p50 4.5 us, p99 10.0 us"}],'
        b'"avatars":[{"track":{"latency_us":{"f64":"AAAA"},"steps":1}}]}</script>')
ANSWER = (b'{"avatar":1,"session":1000,"sequence":[0,1],"utime":[1010,1020],"contacts":[{"toi":0.5,'
          b'"utime":1015}],"receive_utime":7,"send_utime":8,"query_us":9.5}\n')
FIGURES = b"steps 136\nof 137 contacts, 87 (63.5 %) touch\nlatency of a step, us mean 3.1\n"


def log_of(identity, payload):
    """A log of one event and its block, with this id and check sums that follow from it."""
    block = bytes(8) + identity * 8 + bytes(72) + identity * 16
    events = ((b"POSE", payload), (b"FORETOUCH_LOG_BLOCK", block))
    return b"".join(normalise.LOG_EVENT.pack(0xEDA1DA01, 0, 5, len(name), len(content)) + name
                    + content for name, content in events)


def glb_of(text, binary):
    head = struct.pack("<4sIII", b"glTF", 2, 0, len(text)) + b"JSON"
    return head + text + struct.pack("<I", len(binary)) + b"BIN\0" + binary


class Normalised(unittest.TestCase):
    def expect(self, normal, content, same, other):
        """`same` is no other output than `content`, `other` is."""
        self.assertEqual(normal(content), normal(same))
        self.assertNotEqual(normal(content), normal(other))

    def test_results_but_for_latency_and_version(self):
        self.expect(normalise.results, RESULTS,
                    RESULTS.replace(b"3.1", b"12.25").replace(b"0.1.0", b"0.2.0"),
                    RESULTS.replace(b"0.4128", b"0.4129"))

    def test_documents_but_for_latencies_and_version(self):
        self.expect(normalise.document, PAGE,
                    PAGE.replace(b"AAAA", b"BBBB").replace(b"4.5 us", b"5.5 us")
                    .replace(b"0.1.0", b"1.0.0"), PAGE.replace(b'"steps":1', b'"steps":2'))

    def test_words_of_documents_apart_from_their_data(self):
        reworded = normalise.document(PAGE.replace(b"a b", b"a c"))
        self.assertEqual(normalise.document(PAGE)["data"], reworded["data"])
        self.assertNotEqual(normalise.document(PAGE)["words"], reworded["words"])

    def test_logs_but_for_their_ids(self):
        self.expect(normalise.event_log, log_of(b"a", b"pose"), log_of(b"b", b"pose"),
                    log_of(b"a", b"poze"))

    def test_answers_since_their_session_began(self):
        later = (ANSWER.replace(b"1000", b"5000").replace(b"1010,1020", b"5010,5020")
                 .replace(b"1015", b"5015").replace(b'_utime":7', b'_utime":77')
                 .replace(b'_utime":8', b'_utime":88').replace(b"9.5", b"1.5"))
        self.expect(normalise.answers, ANSWER, later, ANSWER.replace(b"1015", b"1016"))

    def test_glb_but_for_the_version(self):
        text = b'{"asset":{"generator":"foretouch 0.1.0"}}'
        content = glb_of(text, b"1234")
        self.expect(normalise.glb, content, glb_of(text.replace(b"0.1.0", b"0.2.0"), b"1234"),
                    glb_of(text, b"1235"))

    def test_figures_but_for_words_and_times(self):
        self.expect(normalise.figures, FIGURES,
                    FIGURES.replace(b"touch", b"meet").replace(b"3.1", b"4.1"),
                    FIGURES.replace(b"63.5", b"63.6"))


    def test_summaries_but_for_latencies_and_folders(self):
        content = b'{"motion":"/a/b.bvh","ticks":3,"latency_us":{"p50":1.5,"p99":2},"output":"c"}'
        self.expect(normalise.summary, content,
                    content.replace(b"1.5", b"2.5").replace(b"/a/", b"/x/y/"),
                    content.replace(b"b.bvh", b"c.bvh"))

    def test_shown_poses_but_for_the_version_and_marks_of_lines(self):
        content = b'{"tool":"0.1.0","motion_mark":"ab","mark":"01"}\n{"from":"cd","mark":"02"}\n'
        self.expect(normalise.marked, content,
                    content.replace(b"0.1.0", b"0.2.0").replace(b'"mark":"0', b'"mark":"1'),
                    content.replace(b"cd", b"ce"))


class Recorded(unittest.TestCase):
    def test_widths_that_agree_share_a_digest(self):
        one, other = {"sha256": "1"}, {"sha256": "2"}
        written = digests.by_digest({"avx2": other, "scalar": one, "sse4": one})
        self.assertEqual(written, '"scalar sse4": {"sha256": "1"}, "avx2": {"sha256": "2"}')
        self.assertEqual(digests.by_width({"scalar sse4": one, "avx2": other}),
                         {"scalar": one, "sse4": one, "avx2": other})

    def test_widths_that_were_not_run_stay_unless_others_moved(self):
        was = {"sse4": "a", "avx2": "b"}
        self.assertEqual(digests.renewed(was, {"avx2": "b", "scalar": "c"}),
                         {"sse4": "a", "avx2": "b", "scalar": "c"})
        self.assertEqual(digests.renewed(was, {"avx2": "d"}), {"avx2": "d"})
        self.assertEqual(digests.renewed(was, {}), was)


class FirstDifference(unittest.TestCase):
    def test_names_line_and_column(self):
        told = digests.first_difference(b"one\ntwo three\nfour", b"one\ntwo throe\nfour")
        self.assertIn("line 2, column 8", told)
        self.assertIn("two three", told)
        self.assertIn("two throe", told)

    def test_an_end_that_is_missing(self):
        self.assertIn("line 2, column 2", digests.first_difference(b"one\ntwo", b"one\nt"))


if __name__ == "__main__":
    unittest.main()
