// The menu under the right button.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/handles.h"

#include <QMenu>
#include <QPointF>

namespace lampblack
{

/// What can be done at a place of the canvas. Rebuilt each time that it opens.
class LampMenu : public QMenu
{
    Q_OBJECT

public:
    LampMenu(Host& host, SceneDocument& document, QWidget* parent);

    /// `canvas` is the place in canvas pixels; `handle` what is there; `colour` the flat colour there,
    /// "#rrggbb" or empty.
    void openAt(const QPointF& canvas, const QPoint& global, const Handle& handle, const QString& colour);

Q_SIGNALS:
    void editMaterialRequested(const QString& colour);

private:
    void fill(const QPointF& canvas, const Handle& handle, const QString& colour);
    void fillLight(const QPointF& canvas, int light);
    void fillFloor(const QPointF& canvas, bool isUnderPointer);
    template <class Thing>
    void fillKeys(const Thing& thing, const std::function<void(const QString&, const Thing&)>& change);
    void fillMaterial(const QString& colour);
    QAction* add(const char* name, const QString& text, const std::function<void()>& act);

    Host& mHost;
    SceneDocument& mDocument;
};

/// `scene` with its lights, ambient light and floor as a new project has them.
Scene withLightingReset(Scene scene);

/// A square of a colour with a thin edge, for menus and buttons.
QIcon colourIcon(const QColor& colour, int side, double pixelRatio);

} // namespace lampblack
