// The plugin as a whole: "Generate Surfaces" and "Render All Frames", from the button to the end.
#include "protocol/generated/apart_layers.h"
#include "scene/layer_roles.h"
#include "support/studio_test.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QProgressBar>

using namespace lampblack;

class StudioJobsTest : public StudioTest
{
    Q_OBJECT

private:
    void click(const char* button) const { find<QAbstractButton>(button)->click(); }
    QAction* entry(const char* name) const
    {
        const QString wanted = QStringLiteral("lampblack.") + QLatin1String(name);
        for (QAction* action : mHost->mLightMenu)
            if (action->objectName() == wanted)
                return action;
        return nullptr;
    }
    void chooseApart(ApartKind kind) const
    {
        auto* apart = find<QComboBox>("panel.apart");
        apart->setCurrentIndex(apart->findData(int(kind)));
    }
    static QString layerOf(const char* folder) { return resultLayer(QLatin1String(folder)); }
    /// The worker writes its files: of highlight, rim and glow, blank ones.
    void finishApart()
    {
        for (const char* folder : protocol::ApartLayers)
        {
            const QString path = mFolder->filePath(QStringLiteral("walk_lit/") + QLatin1String(folder));
            QVERIFY(QDir().mkpath(path));
            QImage picture(4, 3, QImage::Format_ARGB32);
            const QStringList drawn{QStringLiteral("drawing"), QStringLiteral("floor_shadow"),
                                    QStringLiteral("shade"), QStringLiteral("light")};
            picture.fill(drawn.contains(QLatin1String(folder)) ? Qt::red : Qt::transparent);
            for (int frame = 1; frame <= 8; ++frame)
                QVERIFY(picture.save(QStringLiteral("%1/walk.000%2.png").arg(path).arg(frame)));
        }
        mWorker->finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        mWorker->endJob();
        QTRY_VERIFY(!isWorking());
    }
    /// Top first.
    QStringList visibleResults() const
    {
        QStringList names;
        for (const Layer& layer : qAsConst(mHost->mLayers))
            if (layer.visible && isResult(layer.name, {}))
                names << layer.name;
        return names;
    }
    bool isWorking() const { return !find<QWidget>("panel.job")->isHidden(); }

private Q_SLOTS:
    void aLightThatIsNotSavedMarksTheTitle()
    {
        setPower(3);
        QVERIFY(mHost->mMarked);
        Q_EMIT mHost->projectSaved(mHost->mProject);
        QVERIFY(!mHost->mMarked);
    }

    void renderNeedsNoLamp()
    {
        click("panel.render");
        QCOMPARE(mWorker->mStarted, 1);
        QCOMPARE(mWorker->mScenes.last(), defaultScene(mHost->canvasSize()));
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
        QCOMPARE(mWorker->mFrames, QStringLiteral("1-8"));
        QCOMPARE(mWorker->mOutput, mFolder->filePath(QStringLiteral("walk_lit/walk.%04d.png")));
        QVERIFY(isWorking());

        mWorker->finishFrames({1, 2, 3});
        Q_EMIT mWorker->renderProgress(mWorker->mJob, 3, 1, 3, 8);
        QCOMPARE(find<QProgressBar>("panel.progress")->value(), 3);
        QVERIFY(mHost->mStatus.contains(QLatin1String("Rendering: 3 of 8")));
        mWorker->finishFrames({4, 5, 6, 7, 8});
        mWorker->endJob();
        QTRY_VERIFY(!isWorking());
        QCOMPARE(mHost->mDelivered.size(), 8);
        QVERIFY(mHost->mStatus.contains(QLatin1String("8 lit frames")));
        const int requests = mHost->mRequests.size();
        Q_EMIT mHost->drawingChanged(1);
        QCOMPARE(mHost->mRequests.size(), requests);
    }

    void chosenFramesAreRendered_data()
    {
        QTest::addColumn<int>("choice");
        QTest::addColumn<QString>("frames");
        QTest::newRow("all") << 0 << "1-8";
        QTest::newRow("loop") << 1 << "3-5";
        QTest::newRow("current") << 2 << "2";
    }

    void chosenFramesAreRendered()
    {
        QFETCH(int, choice);
        mHost->mLoop = {3, 5};
        mHost->mFrame = 2;
        find<QComboBox>("panel.range")->setCurrentIndex(choice);
        Q_EMIT find<QComboBox>("panel.quality")->activated(int(Quality::Final));
        click("panel.render");
        QTEST(mWorker->mFrames, "frames");
        QCOMPARE(mWorker->mQuality, Quality::Final);
    }

    void cancelledRenderEnds()
    {
        click("panel.render");
        click("panel.cancel");
        QCOMPARE(mWorker->mCancelled, 1);
        QVERIFY(!isWorking());
        QCOMPARE(mHost->mStatus, QStringLiteral("Cancelled."));
        mWorker->endJob();
        QTest::qWait(20);
        QVERIFY(mHost->mDelivered.isEmpty());
    }

    void aRenderFromTheMenuCanBeCancelledWithoutThePanel()
    {
        mHost->mWindow.show();
        mHost->mPanel->hide();
        auto* cancel = find<QAbstractButton>("status.cancel");
        QVERIFY(!cancel->isVisible());
        entry("render")->trigger();
        QVERIFY(cancel->isVisible());
        QVERIFY(entry("cancel")->isEnabled());
        cancel->click();
        QCOMPARE(mWorker->mCancelled, 1);
        QVERIFY(!cancel->isVisible());
        QVERIFY(!entry("cancel")->isEnabled());
    }

    void framesTakenApartBecomeLayers()
    {
        chooseApart(ApartKind::Pencil2d);
        click("panel.render");
        QCOMPARE(mWorker->mApart, ApartKind::Pencil2d);
        QCOMPARE(mWorker->mOutput, mFolder->filePath(QStringLiteral("walk_lit/walk.%04d.png")));
        finishApart();
        const QStringList made{layerOf("drawing"), layerOf("floor_shadow"), layerOf("shade"),
                               layerOf("light")};
        QCOMPARE(mHost->mAllDelivered, made); // nothing is drawn in the others
        QCOMPARE(mHost->mDelivered.value(8),
                 mFolder->filePath(QStringLiteral("walk_lit/light/walk.0008.png")));
        QVERIFY(mHost->mStatus.contains(QStringLiteral("\"Lit: …\"")));
        QCOMPARE(visibleResults(), (QStringList{made[3], made[2], made[1], made[0]}));

        // One picture takes their place, and they its.
        chooseApart(ApartKind::None);
        click("panel.render");
        mWorker->finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        mWorker->endJob();
        QTRY_VERIFY(!isWorking());
        QCOMPARE(visibleResults(), QStringList{QStringLiteral("Lit")});
        chooseApart(ApartKind::Pencil2d);
        click("panel.render");
        finishApart();
        QCOMPARE(visibleResults().size(), made.size());
    }

    void whatHasChangedStaysApart()
    {
        mHost->open();
        chooseApart(ApartKind::Pencil2d);
        click("panel.render");
        finishApart();
        chooseApart(ApartKind::None);
        draw();
        QTRY_VERIFY(!find<QWidget>("panel.render_changed")->isHidden());
        click("panel.render_changed");
        QTRY_COMPARE(mWorker->mFrames, QStringLiteral("1"));
        QCOMPARE(mWorker->mApart, ApartKind::Pencil2d);
    }

    void framesInExrAreFilesOnly()
    {
        chooseApart(ApartKind::Exr);
        click("panel.render");
        QCOMPARE(mWorker->mOutput, mFolder->filePath(QStringLiteral("walk_lit/walk.%04d.exr")));
        mWorker->finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        mWorker->endJob();
        QTRY_VERIFY(!isWorking());
        QVERIFY(mHost->mAllDelivered.isEmpty());
        QVERIFY(mHost->mStatus.contains(QLatin1String("8 of 8 frames are in")));
    }

    void renderWithoutAProjectIsRefused()
    {
        mHost->mProject.clear();
        click("panel.render");
        QVERIFY(!isWorking());
        QCOMPARE(mWorker->mJob, 0ULL);
        QVERIFY(!find<QWidget>("panel.problem")->isHidden());
    }

    void jobGoesOnWithoutTheLamp()
    {
        mHost->open();
        mHost->mDraw = {}; // the host is busy
        click("panel.render");
        const int cancelled = mHost->mCancelled;
        mHost->mTool->setChecked(false);
        QCOMPARE(mHost->mCancelled, cancelled);
        const QVector<FakeHost::Request> waiting = mHost->mRequests;
        for (const FakeHost::Request& request : waiting)
            Q_EMIT mHost->frameExported({request.first, drawing(), {}, request.layers});
        QCOMPARE(mWorker->mFrames, QStringLiteral("1-8"));
    }

    void litFramesThatNoLongerFitAreRenderedAgain()
    {
        const auto outdated = [this]
        {
            auto* label = find<QLabel>("panel.outdated");
            return label->isHidden() ? QString() : label->text();
        };
        const auto finishJob = [this](const QVector<int>& frames)
        {
            mWorker->finishFrames(frames);
            mWorker->endJob();
            QTRY_VERIFY(!isWorking());
        };
        mHost->open();
        click("panel.render");
        finishJob({1, 2, 3, 4, 5, 6, 7, 8});
        QTest::qWait(150);
        QCOMPARE(outdated(), QString());

        // A stroke on frame 1, and one that is undone on frame 2.
        draw();
        QTRY_COMPARE(outdated(), QStringLiteral("1 of 8 lit frames are out of date"));
        mHost->goToFrame(2);
        QTRY_VERIFY(mWorker->mPut.contains(2));
        Q_EMIT mHost->drawingChanged(2);
        QTest::qWait(150);
        QCOMPARE(outdated(), QStringLiteral("1 of 8 lit frames are out of date"));
        click("panel.render_changed");
        QTRY_COMPARE(mWorker->mFrames, QStringLiteral("1"));
        finishJob({1});
        QTRY_COMPARE(outdated(), QString());
        QCOMPARE(mHost->mDelivered.size(), 8);

        setPower(2.5);
        QTRY_COMPARE(outdated(), QStringLiteral("8 of 8 lit frames are out of date"));
        setPower(1.2);
        QTRY_COMPARE(outdated(), QString());
    }

    void artistIsToldWhenTheLayerHidesTheDrawing()
    {
        mHost->open();
        click("panel.render");
        mWorker->finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        mWorker->endJob();
        QTRY_VERIFY(!isWorking());
        mHost->mCurrentLayer = QStringLiteral("Line");
        mHost->mTool->setChecked(false);
        QVERIFY(mHost->mStatus.contains(QLatin1String("hides what you draw")));
        mHost->mStatus.clear();
        mHost->mLayers.first().visible = false;
        draw();
        QVERIFY(!mHost->mStatus.contains(QLatin1String("hides what you draw")));
    }

    void surfacesAreMadeOfAllFrames()
    {
        click("panel.generate");
        QCOMPARE(mWorker->mStarted, 1);
        QCOMPARE(mWorker->mPut.size(), 8);
        Q_EMIT mWorker->framesLit(3, 8);
        QCOMPARE(find<QProgressBar>("panel.progress")->value(), 3);
        QVERIFY(isWorking());
        // A ninth frame, held from before, is no part of the job.
        Q_EMIT mWorker->framesLit(7, 9);
        QCOMPARE(find<QProgressBar>("panel.progress")->value(), 6);
        QCOMPARE(find<QProgressBar>("panel.progress")->maximum(), 8);
        QCOMPARE(mHost->mStatus, QStringLiteral("Generating surfaces: 6 of 8"));
        Q_EMIT mWorker->framesLit(9, 9);
        QVERIFY(!isWorking());
        QCOMPARE(mWorker->mJob, 0ULL);
    }
};

QTEST_MAIN(StudioJobsTest)
#include "test_studio_jobs.moc"
