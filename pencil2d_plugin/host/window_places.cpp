#include "host/window_places.h"

#include <QScreen>
#include <QStatusBar>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int UsualFrame = 36; ///< height of a title bar and borders, pixels

QDockWidget* dockOf(const QMainWindow& window, const char* type)
{
    const auto docks = window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (QDockWidget* dock : docks)
    {
        if (isClass(dock, type))
            return dock;
    }
    return nullptr;
}

/// Make `dock` a tab of `other`, if one is above the other.
void fold(QMainWindow& window, QDockWidget* other, QDockWidget* dock)
{
    if (other == nullptr || dock == nullptr || other->isHidden() || dock->isHidden() || other->isFloating() ||
        dock->isFloating() || window.dockWidgetArea(other) != window.dockWidgetArea(dock) ||
        window.tabifiedDockWidgets(other).contains(dock))
        return;
    window.tabifyDockWidget(other, dock);
    other->raise();
}

} // namespace

WindowPlaces::~WindowPlaces()
{
    delete mLight;
}

void WindowPlaces::addDock(QDockWidget* dock)
{
    if (mParts.window == nullptr)
        return;
    // Pencil2D restores its window before there is our dock. Qt keeps the place of a dock that it misses.
    if (!mParts.window->restoreDockWidget(dock))
    {
        mParts.window->addDockWidget(Qt::RightDockWidgetArea, dock);
        QDockWidget* palette = dockOf(*mParts.window, "ColorPaletteWidget");
        if (palette != nullptr && !palette->isFloating() &&
            mParts.window->dockWidgetArea(palette) == Qt::RightDockWidgetArea)
        {
            mParts.window->tabifyDockWidget(palette, dock);
            palette->raise();
        }
    }
    if (auto* menu = mParts.window->findChild<QMenu*>(QStringLiteral("menuWindows")))
        menu->addAction(dock->toggleViewAction());
    fitToScreen(dock);
}

void WindowPlaces::fitToScreen(QDockWidget* ours)
{
    QMainWindow& window = *mParts.window;
    // The window manager may not have put its frame around the window yet.
    const int frame = std::max(UsualFrame, window.frameGeometry().height() - window.height());
    const int room = window.screen()->availableGeometry().height() - frame;
    const auto tooHigh = [&window, room]
    {
        return window.minimumSizeHint().height() > room;
    };
    if (tooHigh())
        fold(window, dockOf(window, "ColorPaletteWidget"), ours);
    // Not even Pencil2D alone fits.
    if (tooHigh())
        fold(window, dockOf(window, "ColorBox"), dockOf(window, "ColorInspector"));
    if (tooHigh())
        fold(window, dockOf(window, "DisplayOptionWidget"), dockOf(window, "OnionSkinWidget"));
    if (tooHigh())
    {
        fold(window, dockOf(window, "ColorBox"), dockOf(window, "ColorPaletteWidget"));
        fold(window, dockOf(window, "ColorBox"), ours);
    }
    if (tooHigh())
    {
        fold(window, mParts.options, dockOf(window, "DisplayOptionWidget"));
        fold(window, mParts.options, dockOf(window, "OnionSkinWidget"));
    }
    if (window.height() > room)
        window.resize(window.width(), room);
}

void WindowPlaces::addLightAction(QAction* action)
{
    if (mParts.window == nullptr)
        return;
    auto* animation = mParts.window->findChild<QMenu*>(QStringLiteral("menuAnimation"));
    if (animation == nullptr)
    {
        mParts.window->addAction(action);
        return;
    }
    if (mLight == nullptr)
    {
        mLight = new QMenu(QObject::tr("Light"), animation);
        mLight->setObjectName(QStringLiteral("lampblack.light_menu"));
        mLight->setToolTipsVisible(true);
        QAction* separator = animation->addSeparator();
        QObject::connect(mLight, &QObject::destroyed, separator, &QObject::deleteLater);
        animation->addMenu(mLight);
    }
    mLight->addAction(action);
}

void WindowPlaces::addStatusWidget(QWidget* widget)
{
    if (mParts.window != nullptr)
        mParts.window->statusBar()->addPermanentWidget(widget);
}

} // namespace lampblack
