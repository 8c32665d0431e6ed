# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 400
"""A property out of its range, or not a number, gets one error that names the property, from every source and filter."""

import os

from cactus_testing import UNPARTED, CactusTestCase, fetch, main, make, proxies, switches_of
from paraview import simple
from paraview.servermanager import vtkSMPropertyHelper
from surfaces import two_tubes


def numbers(element):
    return [
        one
        for one in element
        if one.tag in ("DoubleVectorProperty", "IntVectorProperty") and one.get("information_only") != "1"
    ]


def bad_values(one):
    """Just outside the range in the XML, beside the choices, and not a number."""
    whole = one.tag == "IntVectorProperty"
    for domain in one:
        if domain.tag in ("DoubleRangeDomain", "IntRangeDomain"):
            least, most = (float(domain.get(name)) if domain.get(name) is not None else None for name in ("min", "max"))
            if least is not None:
                yield least - 1
                yield from () if whole or least == 0 else (least * (0.9 if least > 0 else 1.1),)
            if most is not None:
                yield most + 1 if whole else most * 1.001
        elif domain.tag == "EnumerationDomain":
            values = [int(entry.get("value")) for entry in domain.findall("Entry")]
            yield from (min(values) - 1, max(values) + 1)
    if not whole:
        yield from (float("nan"), float("inf"))


class PropertyRanges(CactusTestCase):
    expected = UNPARTED

    @classmethod
    def setUpClass(cls):
        """A good input for each kind of data."""
        fibres = simple.BundleInitializer(Side=6, FibreVolumeFraction=0.2, MinimumRadius=0.4, MeanDispersion=2, GrownFibreVolumeFraction=0)
        image = simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.2, GrowthIterations=1)
        cls.fibres, cls.image = fetch(fibres), fetch(image)
        _, cls.outer, _ = two_tubes()
        simple.Delete(image)
        simple.Delete(fibres)

    def make(self, element, one):
        """The source or filter with good inputs, and with what switches the property on."""
        proxy = make(element, {"Outer": self.outer, "vtkPolyData": self.fibres, "vtkImageData": self.image})
        switches = switches_of(one)
        while switches:
            name, is_inverse, value = switches.pop()
            if is_inverse:  # any but 0, or none
                self.give(proxy, name)
            else:
                vtkSMPropertyHelper(proxy.SMProxy, name).Set(float(value))
            for switch in element.findall(f"*[@name='{name}']"):
                switches += switches_of(switch)
        return proxy

    def give(self, proxy, name):
        """Any value but 0, and some text."""
        kind = proxy.SMProxy.GetProperty(name).GetClassName()
        value = {"vtkSMStringVectorProperty": os.path.join(self.folder, "given"), "vtkSMDoubleVectorProperty": 0.5}.get(kind, 1)
        vtkSMPropertyHelper(proxy.SMProxy, name).Set(value)

    def test_each_gets_one_error_that_names_it(self):
        checked = 0
        for element in (element for group, element in proxies() if group in ("sources", "filters")):
            for one in numbers(element):
                proxy = self.make(element, one)
                for value in bad_values(one):
                    with self.subTest(proxy=element.get("name"), property=one.get("name"), value=value):
                        vtkSMPropertyHelper(proxy.SMProxy, one.get("name")).Set(value)
                        proxy.SMProxy.UpdateVTKObjects()
                        with self.assertError(one.get("name")):
                            proxy.UpdatePipeline()
                        checked += 1
                simple.Delete(proxy)
        self.assertGreater(checked, 20)


if __name__ == "__main__":
    main()
