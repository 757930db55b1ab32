// Our docks, menu entries and widgets in Pencil2D's window.
#pragma once

#include "host/parts.h"

#include <QMenu>

namespace lampblack
{

class WindowPlaces
{
public:
    explicit WindowPlaces(const Parts& parts) : mParts(parts) {}
    ~WindowPlaces();

    /// Where the artist left it; at first behind the colour palette, as a tab, so that the window needs no
    /// more height than without us.
    void addDock(QDockWidget* dock);
    /// Into the submenu "Light" of the Animation menu.
    void addLightAction(QAction* action);
    void addStatusWidget(QWidget* widget);

private:
    /// Make docks tabs of one another until the window is no higher than the screen.
    void fitToScreen(QDockWidget* ours);

    Parts mParts;
    QPointer<QMenu> mLight;
};

} // namespace lampblack
