# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""Presets: one choice gives all stages their values, names only what is so, and never takes from a user what he has set."""

import os
import re
import sys

from cactus_testing import CactusTestCase, fetch, main
from paraview import servermanager, simple, smstate
from paraview.servermanager import vtkSMPropertyHelper

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples"))
import paper  # noqa: E402  (which is in another folder)

ALIVE, FIXED, TUTORIAL, TARGET = "Corpus callosum, in-vivo-like", "Corpus callosum, EM-like", "Tutorial bundle", "Histological target "


def unchecked(proxy, name):
    """What a panel shows before Apply."""
    return proxy.SMProxy.GetProperty(name).GetUncheckedElement(0)


def edit(proxy, name, value):
    """What a panel does when somebody changes a value in it."""
    proxy.SMProxy.GetProperty(name).SetUncheckedElement(0, value)


class Presets(CactusTestCase):
    expected = r"so small a domain holds more or less by chance|too few to be interwoven"

    def chain(self, **bundle):
        initial = simple.BundleInitializer(**{"Preset": "None", "Side": 6, **bundle})
        optimiser = simple.CapsuleOptimizer(Input=initial)
        growth = simple.FibreRadialGrowth(Input=simple.OutputPort(optimiser, 0))
        return initial, growth, simple.MyelinSurface(Input=growth)

    def number(self, name):
        bundle = simple.BundleInitializer()
        found = bundle.GetProperty("Preset").Available.index(name)
        simple.Delete(bundle)
        return found

    def test_every_stage_takes_that_of_the_bundle(self):
        initial, growth, myelin = self.chain(Preset=TARGET + "b", Side=7)
        self.assertEqual((initial.Side, initial.GrownFibreVolumeFraction), (7, 0.68))
        self.assertEqual((myelin.GRatioModel, myelin.TargetAxonVolumeFraction), ("TargetAxonVolumeFraction", 0.25))
        self.assertEqual([one.Preset for one in (initial, growth, myelin)], [TARGET + "b"] * 3)
        production = simple.SubstrateProduction(Input=growth.Input)
        self.assertEqual((production.Preset, production.TargetAxonVolumeFraction), (TARGET + "b", 0.25))

    def test_none_is_the_default_and_changes_nothing(self):
        for one in self.chain():
            self.assertEqual(one.Preset, "None")
        self.assertEqual([one.Available[0] for one in (simple.BundleInitializer().GetProperty("Preset"),)], ["None"])

    def test_what_a_script_says_is_its_own(self):
        initial, _, _ = self.chain(Preset=ALIVE, MeanDispersion=3)
        self.assertEqual((initial.MeanDispersion, initial.GrownFibreVolumeFraction, initial.Preset), (3, 0.8, "None"))
        self.assertEqual(simple.FibreRadialGrowth(Input=initial).Preset, ALIVE)
        initial.Preset = ALIVE
        initial.Preset = "None"
        self.assertEqual(simple.FibreRadialGrowth(Input=initial).Preset, "None")
        _, growth, _ = self.chain(Preset=ALIVE)
        other = simple.FibreRadialGrowth(Input=growth.Input, MinimumGap=0.03, VoxelSize=0.2)
        self.assertEqual((other.MinimumGap, other.VoxelSize, other.Preset), (0.03, 0.2, "None"))
        chosen = simple.FibreRadialGrowth(Input=growth.Input, Preset=FIXED)
        self.assertEqual((chosen.MinimumGap, chosen.SurfaceTolerance, chosen.Preset), (0.02, 0.0065, FIXED))

    def test_a_default_that_a_script_gives_is_its_own_too(self):
        initial, growth, _ = self.chain(Preset=TARGET + "b")
        given = {"GRatioModel": "Constant", "GRatio": 0.7}
        made = [simple.MyelinSurface(**said) for said in ({"Input": growth, **given}, {**given, "Input": growth}, {"Input": growth, "Preset": "None"})]
        made.append(simple.SubstrateProduction(Input=growth.Input, **given))
        for one in made:
            self.assertEqual((one.GRatioModel, one.GRatio, one.Preset), ("Constant", 0.7, "None"))
        initial.Preset = TARGET + "a"
        for one in (made[0], made[1], made[3]):
            self.assertEqual((one.GRatioModel, one.Preset), ("Constant", "None"))
        initial.Preset = ALIVE
        narrow = simple.FibreRadialGrowth(Input=growth.Input, MinimumGap=0.02)
        self.assertEqual((narrow.MinimumGap, narrow.Preset), (0.02, "None"))

    def test_none_of_a_filter_that_follows_is_its_defaults(self):
        initial, growth, myelin = self.chain(Preset=TARGET + "b")
        myelin.Preset = "None"
        self.assertEqual((myelin.GRatioModel, myelin.TargetAxonVolumeFraction), ("Constant", 0))
        initial.Preset = ALIVE
        edit(growth, "Preset", 0)
        self.assertEqual((unchecked(growth, "MinimumGap"), growth.MinimumGap), (0.02, 0.04))
        edit(growth, "MinimumGap", 0.03)
        self.apply(growth, ["Preset", "MinimumGap", "SurfaceTolerance"])
        self.assertEqual((growth.MinimumGap, growth.Preset), (0.03, "None"))
        initial.Preset = "None"
        self.assertEqual(initial.GrownFibreVolumeFraction, 0.8)

    def test_a_changed_value_is_no_preset(self):
        initial, growth, myelin = self.chain(Preset=ALIVE)
        for one, name, value in ((initial, "GammaShape", 3), (growth, "MinimumGap", 0.05), (myelin, "GRatio", 0.6), (initial, "RadiusDistribution", "Lognormal")):
            one.SetPropertyWithName(name, value)
            self.assertEqual(one.Preset, "None")
            self.assertEqual(one.GetPropertyValue(name), value)
            one.Preset = ALIVE
            self.assertNotEqual(one.GetPropertyValue(name), value)
        for one, name in ((initial, "Side"), (initial, "Seed"), (growth, "VoxelSize"), (myelin, "DecimationError")):
            one.SetPropertyWithName(name, 2 * one.GetPropertyValue(name))
            self.assertEqual(one.Preset, ALIVE)

    def test_one_preset_after_the_other_leaves_nothing_of_the_first(self):
        initial, growth, myelin = self.chain(Side=8, Border="Walls")
        for name in initial.GetProperty("Preset").Available[1:]:
            initial.Preset = name
            fresh = self.chain(Preset=name, Side=8, Border="Walls")
            for one, other in zip((initial, growth, myelin), fresh):
                self.assertEqual(one.Preset, name)
                for each in one.ListProperties():
                    if each != "Input":
                        self.assertEqual(one.GetPropertyValue(each), other.GetPropertyValue(each), f"{name}: {each}")

    def test_stages_follow_the_bundle_but_where_they_were_changed(self):
        initial, growth, myelin = self.chain()
        growth.MinimumGap = 0.03
        initial.Preset = ALIVE
        self.assertEqual((growth.Preset, growth.MinimumGap, myelin.Preset), ("None", 0.03, ALIVE))
        myelin.Preset = TARGET + "a"
        initial.Preset = FIXED
        self.assertEqual((growth.MinimumGap, myelin.Preset), (0.03, TARGET + "a"))

    def test_a_panel_shows_it_before_apply(self):
        initial, growth, _ = self.chain()
        edit(initial, "Preset", self.number(ALIVE))
        self.assertEqual((unchecked(initial, "GrownFibreVolumeFraction"), initial.GrownFibreVolumeFraction), (0.8, 0.9))
        self.assertEqual(growth.Preset, "None")
        edit(initial, "GammaShape", 5.0)
        self.assertEqual((unchecked(initial, "Preset"), unchecked(initial, "GrownFibreVolumeFraction")), (0, 0.8))
        edit(initial, "Preset", self.number(ALIVE))
        self.assertEqual(unchecked(initial, "GammaShape"), 2.64)

    def apply(self, proxy, names):
        """What Apply does, property by property, in the order that is given."""
        for name in names:
            vtkSMPropertyHelper(proxy.SMProxy, name).Set(unchecked(proxy, name))
        proxy.SMProxy.UpdateVTKObjects()

    def test_apply_in_any_order_gives_what_the_panel_shows(self):
        initial, _, _ = self.chain()
        names = ["Preset", *(one for one in initial.ListProperties() if one in ("GammaShape", "GammaScale", "MeanDispersion", "GrownFibreVolumeFraction"))]
        for order in (names, names[::-1]):
            for preset, shape in ((ALIVE, None), (TUTORIAL, None), (ALIVE, 4.0), (TUTORIAL, None)):
                edit(initial, "Preset", self.number(preset))
                if shape:
                    edit(initial, "GammaShape", shape)
                shown = [unchecked(initial, name) for name in names]
                self.apply(initial, order)
                self.assertEqual([vtkSMPropertyHelper(initial.SMProxy, name).GetAsDouble() for name in names], shown)
                self.assertEqual(initial.Preset, "None" if shape else preset)

    def test_a_state_file_brings_back_the_same(self):
        initial, growth, myelin = self.chain(Preset=ALIVE, Side=9)
        myelin.GRatio = 0.65
        before = {each: initial.GetPropertyValue(each) for each in initial.ListProperties()}
        path = os.path.join(self.folder, "state.pvsm")
        simple.SaveState(path)
        for proxy in (myelin, growth, growth.Input, initial):
            simple.Delete(proxy)
        simple.LoadState(path)
        found = {proxy.GetXMLName(): proxy for proxy in simple.GetSources().values()}
        self.assertEqual({each: found["BundleInitializer"].GetPropertyValue(each) for each in before}, before)
        self.assertEqual((found["FibreRadialGrowth"].Preset, found["FibreRadialGrowth"].MinimumGap), (ALIVE, 0.04))
        self.assertEqual((found["MyelinSurface"].Preset, found["MyelinSurface"].GRatio), ("None", 0.65))

    def test_a_python_state_brings_back_the_same(self):
        """Which says nothing of a value that is the default."""
        _, growth, myelin = self.chain(Preset=TARGET + "b")
        myelin.GRatioModel = "Constant"
        myelin.SmoothingIterations = 3
        simple.RenameSource("plain", simple.FibreRadialGrowth(Input=growth.Input, MinimumGap=0.03))
        simple.RenameSource("behind", simple.MyelinSurface(Input=growth))
        before = self.values_of_all()
        state = smstate.get_state()
        for proxy in list(simple.GetSources().values()):
            simple.Delete(proxy)
        exec(compile(state, "state.py", "exec"), {})  # as ParaView's window does
        self.assertEqual(self.values_of_all(), before)

    def values_of_all(self):
        return {
            name: {each: proxy.GetPropertyValue(each) for each in proxy.ListProperties() if each != "Input"}
            for (name, _), proxy in simple.GetSources().items()
            if proxy.GetProperty("Preset") is not None
        }

    def test_several_bundles_have_one_preset_or_none(self):
        for second, expected in ((ALIVE, ALIVE), (FIXED, "None"), ("None", "None")):
            sources = [simple.BundleInitializer(Preset=preset, Side=6, Border="Walls") for preset in (ALIVE, second)]
            self.assertEqual(simple.FibreRadialGrowth(Input=simple.GroupDatasets(Input=sources)).Preset, expected)

    def test_histological_targets_are_those_of_the_paper(self):
        for i, (target, _) in enumerate(paper.HISTOLOGY):
            bundle, _, myelin = self.chain(Preset=TARGET + "abcd"[i])
            self.assertEqual((myelin.TargetAxonVolumeFraction, bundle.GrownFibreVolumeFraction), (target[0], target[2]))

    def test_axons_are_as_thick_as_published(self):
        """Axons of the finished surfaces, by a preset with a g-ratio and by that with a relation for the myelin."""
        for preset, mean, deviation in (("Human genu (Aboitiz 1992)", 0.48, 0.27), ("Mouse genu (Lee 2019)", 0.51, 0.145)):
            initial, growth, myelin = self.chain(Preset=preset, Side=11)
            self.assertEqual([one.Preset for one in (initial, growth, myelin)], [preset] * 3)
            statistics = simple.SubstrateStatistics(Fibres=simple.OutputPort(myelin, 0))
            column = fetch(statistics, 1).GetColumnByName("InnerRadius_um")
            self._messages = [message for message in self._messages if "with thinner myelin" not in message]
            radii = [radius for radius in (column.GetValue(i) for i in range(column.GetNumberOfTuples())) if radius > 0]
            self.assertGreater(len(radii), 40)
            self.assertAlmostEqual(sum(radii) / len(radii), mean, delta=3 * deviation / len(radii) ** 0.5 + 0.05 * mean, msg=preset)

    def test_substrates_are_as_their_presets_say(self):
        for preset, fraction, gap in ((ALIVE, 0.80, 0.04), (TUTORIAL, 0.90, 0.02)):
            _, growth, myelin = self.chain(Preset=preset, Side=7, Border="Walls", CalibreVariation=0)
            growth.VoxelSize = 0.08
            table = fetch(simple.SubstrateCertificate(Outer=simple.OutputPort(myelin, 0)), 0)
            whole = {table.GetColumnName(i): table.GetValue(0, i).ToDouble() for i in range(table.GetNumberOfColumns())}
            self.assertTrue(whole["Certified"])
            self.assertAlmostEqual(whole["FVF"], fraction, delta=0.01)
            self.assertGreaterEqual(whole["SmallestGap_um"], gap)
            self.assertEqual(whole["MinimumGap_um"], gap)


    def test_a_quarter_of_the_axons_has_no_myelin(self):
        _, _, myelin = self.chain(Preset="Corpus callosum, with unmyelinated axons", Side=10)
        statistics = simple.SubstrateStatistics(Fibres=simple.OutputPort(myelin, 0))
        whole, fibres = fetch(statistics, 0), fetch(statistics, 1)
        self.assertAlmostEqual(whole.GetColumnByName("UnmyelinatedFraction").GetValue(0), 0.008, delta=0.003)
        self.assertAlmostEqual(whole.GetColumnByName("FVF").GetValue(0), 0.8, delta=0.005)
        ratios = fibres.GetColumnByName("GRatio")
        bare = sum(ratios.GetValue(i) == 1 for i in range(fibres.GetNumberOfRows()))
        self.assertAlmostEqual(bare / fibres.GetNumberOfRows(), 0.25, delta=0.1)


class Tutorial(CactusTestCase):
    usual = None

    def test_its_script_runs_as_written_and_warns_of_nothing(self):
        page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "tutorial.md")
        with open(page, encoding="utf-8") as file:
            script = re.search(r"```python\n(.*?)```", file.read(), re.DOTALL).group(1)
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            exec(script, {})
        finally:
            os.chdir(before)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "tutorial.substrate", "manifest.json")))


if __name__ == "__main__":
    main()
