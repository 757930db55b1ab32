// The layers: characters and their lines are lit, backgrounds stay as drawn; and the surface of each.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/section.h"

namespace lampblack
{

class LayersSection : public Section
{
    Q_OBJECT

public:
    LayersSection(Host& host, SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();
    QWidget* nameLabel(const QString& layer);
    QWidget* roleChoice(const QString& layer, const QString& role);
    QWidget* bodyChoice(const QString& layer);
    void setRole(const QString& layer, const QString& role);

    Host& mHost;
    SceneDocument& mDocument;
    QWidget* mRows = nullptr;
    Depth mShownDepth;
};

/// What surface a layer gets.
BodyChoice bodyOf(const Scene& scene, const QString& layer);
Scene withBody(Scene scene, const QString& layer, BodyChoice body);

} // namespace lampblack
