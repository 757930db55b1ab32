// The context menu of the canvas.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/handles.h"

#include <QMenu>
#include <QPointF>

namespace lampblack
{

/// Rebuilt each time it opens.
class LampMenu : public QMenu
{
    Q_OBJECT

public:
    LampMenu(Host& host, SceneDocument& document, QWidget* parent);

    /// `canvas` is the position in canvas pixels, `handle` the handle and `colour` the flat colour there
    /// ("#rrggbb" or empty).
    void openAt(const QPointF& canvas, const QPoint& global, const Handle& handle, const QString& colour);

Q_SIGNALS:
    void editMaterialRequested(const QString& colour);
    void depthRequested(); ///< to show the Depth view

private:
    void fillMenu(const QPointF& canvas, const Handle& handle, const QString& colour);
    void fillLight(const QPointF& canvas, int light);
    void fillFloor(const QPointF& canvas, bool isUnderPointer);
    template <class Thing>
    void fillKeys(const Thing& thing, const std::function<void(const QString&, const Thing&)>& change);
    void fillMaterial(const QString& colour);
    QAction* addEntry(const char* name, const QString& text, const std::function<void()>& onTriggered);

    Host& mHost;
    SceneDocument& mDocument;
};

/// `scene` with the lights, ambient light and floor of a new project.
Scene withLightingReset(Scene scene);

/// A square of this colour with a thin border, for menus and buttons.
QIcon colourIcon(const QColor& colour, int side, double pixelRatio);

} // namespace lampblack
