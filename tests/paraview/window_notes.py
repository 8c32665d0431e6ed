# SPDX-License-Identifier: BSD-3-Clause
"""Run by the ParaView window when it starts: writes down, for every update of a stage, its name and how many points it has then, how deep
fibres lie in each other where it says so, and the preset that it shows in its panel; and, once, that growth works."""

import os

from paraview import servermanager

watched = {}
working = set()


def watch(*_):
    session = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    for index in range(session.GetNumberOfProxies("sources")):
        proxy = session.GetProxy("sources", session.GetProxyName("sources", index))
        if proxy is None or proxy.GetGlobalID() in watched:
            continue
        watched[proxy.GetGlobalID()] = proxy

        def note(*_, proxy=proxy):
            algorithm = proxy.GetClientSideObject()
            if algorithm:
                with open(os.environ["CACTUS_WINDOW_NOTES"], "a") as file:
                    file.write(f"{proxy.GetXMLName()} {algorithm.GetOutputDataObject(0).GetNumberOfPoints()}\n")
                    preset = proxy.GetProperty("Preset")
                    if preset is not None:
                        file.write(f"{proxy.GetXMLName()} has {preset.FindDomain('vtkSMEnumerationDomain').GetEntryTextForValue(preset.GetElement(0))}\n")
                    penetration = algorithm.GetOutputDataObject(0).GetFieldData().GetArray("MaximumPenetration")
                    if penetration:
                        file.write(f"{proxy.GetXMLName()} penetration {penetration.GetValue(0):.4g}\n")

        def note_work(*_, name=proxy.GetXMLName()):
            if name == "FibreRadialGrowth" and name not in working:  # which can be stopped
                working.add(name)
                with open(os.environ["CACTUS_WINDOW_NOTES"], "a") as file:
                    file.write(f"{name} works\n")

        proxy.AddObserver("UpdateDataEvent", note)
        if proxy.GetClientSideObject():
            proxy.GetClientSideObject().AddObserver("ProgressEvent", note_work)


servermanager.vtkSMProxyManager.GetProxyManager().AddObserver("RegisterEvent", watch)
