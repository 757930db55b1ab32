// A panel on a host without a drawing program.
#pragma once

#include "support/fake_host.h"
#include "support/scenes.h"
#include "tool/panel/lamp_panel.h"

#include <memory>

namespace lampblack
{

/// Makes a panel for each test, with one light.
class PanelTest : public QObject
{
    Q_OBJECT

protected:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<SceneDocument> mDocument;
    std::unique_ptr<QAction> mSurfaces;
    std::unique_ptr<QAction> mRender;
    std::unique_ptr<LampPanel> mPanel;

    template <typename Widget> Widget* find(const char* name) const
    {
        return mPanel->findChild<Widget*>(QStringLiteral("lampblack.panel.") + QLatin1String(name));
    }
    void makePanel() { mPanel = std::make_unique<LampPanel>(*mHost, *mDocument, *mSurfaces, *mRender); }
    const AreaLight& light() const { return mDocument->scene().lights[0]; }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mSurfaces = std::make_unique<QAction>();
        mRender = std::make_unique<QAction>();
        makePanel();
        mPanel->resize(200, 500);
        mPanel->show();
    }

    void cleanup() { mPanel.reset(); }
};

} // namespace lampblack
