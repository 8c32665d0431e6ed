# SPDX-License-Identifier: BSD-3-Clause
"""What a Python state that ParaView has saved does to the title of a colour bar, whose UTF-8 it takes for Latin-1."""

from paraview import simple

fibres = simple.BundleInitializer(Side=4, Seed=2)
shown = simple.Show(fibres, simple.GetActiveViewOrCreate("RenderView"))
simple.ColorBy(shown, ("POINTS", "Radius"))
shown.SetScalarBarVisibility(simple.GetActiveView(), True)
simple.GetScalarBar(simple.GetColorTransferFunction("Radius"), simple.GetActiveView()).Title = "Radius (\u00c2\u00b5m)"
