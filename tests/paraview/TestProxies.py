# SPDX-License-Identifier: BSD-3-Clause
"""What the plugin puts before the user: every proxy of every XML file can be made, explains itself, and is named as it is called."""

import re

from cactus_testing import CactusTestCase, main, make, proxies
from paraview import servermanager, simple
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


def properties(element):
    """Those that a user can set."""
    return [child for child in element if child.tag.endswith("Property") and child.get("information_only") != "1"]


def numbers(element):
    return [one for one in properties(element) if one.tag in ("DoubleVectorProperty", "IntVectorProperty")]


def defaults(one):
    return [float(word) for word in (one.get("default_values") or "").split() if word != "none"]


def text(element):
    """The text of its Documentation."""
    documentation = element.find("Documentation")
    return "" if documentation is None else "".join(documentation.itertext()).strip()


class Proxies(CactusTestCase):
    def each(self, check):
        """Calls check(group, XML element) for each proxy; a failure says which one."""
        found = list(proxies())
        self.assertGreater(len(found), 1)
        for group, element in found:
            with self.subTest(proxy=element.get("name")):
                check(group, element)

    def test_can_be_made(self):
        def check(group, element):
            proxy = servermanager.ProxyManager().NewProxy(group, element.get("name"))
            self.assertIsNotNone(proxy)
            proxy.UpdateVTKObjects()
            self.assertEqual(proxy.GetClientSideObject().GetClassName(), element.get("class"))

        self.each(check)

    def test_explain_themselves(self):
        def check(group, element):
            documentation = element.find("Documentation")
            self.assertIsNotNone(documentation)
            self.assertTrue(text(element))
            self.assertTrue(documentation.get("short_help"))
            self.assertTrue(documentation.get("long_help"))

        self.each(check)

    def test_every_property_is_explained(self):
        def check(group, element):
            for one in properties(element):
                self.assertGreater(len(text(one)), 10, f"{one.get('name')} has no documentation")

        self.each(check)

    def test_defaults_lie_inside_their_domains(self):
        def check(group, element):
            for one in numbers(element):
                for domain in one.findall("DoubleRangeDomain") + one.findall("IntRangeDomain"):
                    for value in defaults(one):
                        self.assertGreaterEqual(value, float(domain.get("min", "-inf")), one.get("name"))
                        self.assertLessEqual(value, float(domain.get("max", "inf")), one.get("name"))

        self.each(check)

    def test_defaults_are_those_of_the_xml(self):
        """ParaView may replace a default by one from its domain."""

        def check(group, element):
            if group in ("sources", "filters"):
                proxy = make(element, {"vtkPolyData": vtkPolyData(), "vtkImageData": vtkImageData()})
                for one in numbers(element):
                    values = [proxy.SMProxy.GetProperty(one.get("name")).GetElement(i) for i in range(len(defaults(one)))]
                    self.assertEqual(values, defaults(one), one.get("name"))

        self.each(check)

    def test_python_names_are_the_public_names(self):
        """ParaView makes Python's names from labels: a label must come out as the property's name."""
        def check(group, element):
            if group in ("sources", "filters"):
                label = element.get("label") or element.get("name")
                self.assertEqual(re.sub(r"[^0-9A-Za-z_]", "", label), element.get("name"))
                self.assertTrue(hasattr(simple, element.get("name")))
                names = servermanager._getPyProxy(
                    servermanager.ProxyManager().NewProxy(group, element.get("name"))
                ).ListProperties()
                for one in properties(element):
                    self.assertIn(one.get("name"), names)

        self.each(check)


if __name__ == "__main__":
    main()
