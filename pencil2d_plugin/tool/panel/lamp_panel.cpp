#include "tool/panel/lamp_panel.h"

#include "tool/panel/colour_button.h"
#include "tool/panel/environment_section.h"
#include "tool/panel/layers_section.h"
#include "tool/panel/lights_section.h"
#include "tool/panel/look_section.h"

#include "worker/interpreter.h"

#include <QHBoxLayout>
#include <QScrollBar>
#include <QShowEvent>
#include <QTimer>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr double SmallShare = 0.85;
constexpr double LeastPointSize = 7;
constexpr int FlatButton = 100; // other buttons have the number of their Show as id

int buttonOf(std::optional<Show> mode)
{
    return mode ? int(*mode) : FlatButton;
}

std::optional<Show> modeOf(int button)
{
    return button == FlatButton ? std::nullopt : std::optional<Show>(static_cast<Show>(button));
}

} // namespace

LampPanel::LampPanel(Host& host, SceneDocument& document, QAction& surfaces, QAction& render)
    : mViews(new QButtonGroup(this)), mDepthHelp(new QLabel), mProblem(new ProblemCard),
      mInstall(new InstallCard(findInterpreter().installer)),
      mRender(new RenderSection(host, document, surfaces, render)), mDevice(new DeviceRow(host)),
      mWorkerLine(new WorkerLine), mProgress(new JobProgress(QStringLiteral("lampblack.panel"), false)),
      mHeader(new QWidget(this))
{
    setObjectName(QStringLiteral("lampblack.panel"));
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn); // keeps the width constant
    // The tool options are narrow: with the normal font there would be no room for sliders.
    QFont small = font();
    small.setPointSizeF(std::max(LeastPointSize, SmallShare * small.pointSizeF()));
    auto* content = new QWidget;
    content->setFont(small);
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(3, 3, 3, 3);
    column->setSpacing(3);
    column->addWidget(mProblem);
    column->addWidget(mInstall);
    mDepthHelp->setObjectName(QStringLiteral("lampblack.panel.depth_help"));
    mDepthHelp->setText(tr("Lighter is nearer. The side of a line with teeth is in front.\n"
                           "Click a line: the other side comes in front. Right-click: more.\n"
                           "Drag: draw a line that is missing."));
    mDepthHelp->setWordWrap(true);
    column->addWidget(mDepthHelp);
    if (!host.can(Host::Ability::View))
    {
        auto* blind = new QLabel(host.whyNot(Host::Ability::View));
        blind->setObjectName(QStringLiteral("lampblack.panel.blind"));
        blind->setWordWrap(true);
        column->addWidget(blind);
    }
    auto* lights = new LightsSection(host, document);
    connect(lights, &LightsSection::problem, this, &LampPanel::showProblem);
    column->addWidget(lights);
    column->addWidget(new LookSection(document));
    column->addWidget(new AmbientSection(document));
    column->addWidget(new SurfaceSection(document));
    column->addWidget(new FloorSection(host, document));
    column->addWidget(new LayersSection(host, document));
    column->addWidget(mRender);
    column->addWidget(mDevice);
    column->addStretch(1);
    setWidget(content);
    addHeader(small);
    restoreSections(host);
    connect(mProblem, &ProblemCard::retryRequested, this, &LampPanel::retryRequested);
    connect(mInstall, &InstallCard::installed, this, &LampPanel::retryRequested);
    connect(mDevice, &DeviceRow::computerChosen, this,
            [this]
            {
                mInstall->hide(); // it asks again if this computer is to work, and cannot
                mProblem->settle(UserError::Kind::NoWorker);
                mProblem->settle(UserError::Kind::NoOtherComputer);
            });
    connect(&host, &Host::colourChosen, this,
            [this](const QColor& colour)
            {
                const auto buttons = findChildren<ColourButton*>();
                for (ColourButton* button : buttons)
                    button->choose(colour);
            });
    // Cancel would give the colour of one project to a light of another.
    connect(&host, &Host::projectOpened, this, &LampPanel::closeDialogs);
    connect(&host, &Host::toolActivated, this,
            [this](bool active)
            {
                if (!active)
                    closeDialogs();
            });
}

void LampPanel::closeDialogs()
{
    const auto buttons = findChildren<ColourButton*>();
    for (ColourButton* button : buttons)
        button->closeDialog();
}

void LampPanel::addHeader(const QFont& font)
{
    mHeader->setFont(font);
    auto* column = new QVBoxLayout(mHeader);
    column->setContentsMargins(3, 3, 3, 0);
    column->setSpacing(2);
    column->addWidget(viewSwitch());
    column->addWidget(mWorkerLine);
    column->addWidget(mProgress);
    mHeader->installEventFilter(this);
    placeHeader();
}

void LampPanel::placeHeader()
{
    const int height = mHeader->sizeHint().height();
    setViewportMargins(0, height, 0, 0);
    mHeader->setGeometry(0, 0, viewport()->width(), height);
}

void LampPanel::restoreSections(Host& host)
{
    const auto sections = findChildren<Section*>();
    for (Section* section : sections)
    {
        const QString key = section->name();
        section->setOpen(host.remembered(key, section->isOpen()).toBool());
        connect(section, &Section::toggled, this, [&host, key](bool open) { host.remember(key, open); });
    }
}

bool LampPanel::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == mHeader && event->type() == QEvent::LayoutRequest)
        placeHeader();
    return QScrollArea::eventFilter(watched, event);
}

void LampPanel::resizeEvent(QResizeEvent* event)
{
    QScrollArea::resizeEvent(event);
    placeHeader();
}

QWidget* LampPanel::viewSwitch()
{
    auto* box = new QWidget;
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    const auto add =
        [this, row](std::optional<Show> mode, const QString& name, const QString& text, const QString& hint)
    {
        auto* button = new QToolButton;
        button->setObjectName(QStringLiteral("lampblack.panel.view.") + name);
        button->setText(text);
        button->setToolTip(hint);
        button->setCheckable(true);
        button->setFocusPolicy(Qt::StrongFocus);
        // Widths are proportional to the lengths of the words, and fill the panel.
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        mViews->addButton(button, buttonOf(mode));
        row->addWidget(button, int(text.size()) + 3);
    };
    add(Show::Lit, QStringLiteral("lit"), tr("Lit"), tr("The drawing in its light"));
    add(Show::Normals, QStringLiteral("normals"), tr("Normals"), tr("Which way the surface faces"));
    add(Show::Relief, QStringLiteral("depth"), tr("Depth"),
        tr("Depth: brighter is nearer. See which part is in front, and correct it with a click"));
    add(std::nullopt, QStringLiteral("flat"), tr("Flat"), tr("The drawing without light (or hold D)"));
    setViewMode(Show::Lit);
    connect(mViews, &QButtonGroup::idClicked, this,
            [this](int button) { Q_EMIT viewModeChanged(modeOf(button)); });
    return box;
}

std::optional<Show> LampPanel::viewMode() const
{
    return modeOf(mViews->checkedId());
}

void LampPanel::setViewMode(std::optional<Show> mode)
{
    mViews->button(buttonOf(mode))->setChecked(true);
    mDepthHelp->setVisible(mode == Show::Relief);
}

void LampPanel::setWorkerState(Worker::State state)
{
    mWorkerLine->setState(state);
    if (state == Worker::State::Ready || state == Worker::State::Busy)
    {
        mProblem->settle(UserError::Kind::NoWorker);
        mProblem->settle(UserError::Kind::NoOtherComputer);
    }
}

void LampPanel::showProblem(const UserError& error)
{
    if (error.kind == UserError::Kind::NoWorker && isToInstall(findInterpreter()))
        mInstall->ask();
    else
        mProblem->showError(error);
    verticalScrollBar()->setValue(0);
}

void LampPanel::showEvent(QShowEvent* event)
{
    QScrollArea::showEvent(event);
    // Later, when the dock has laid out its new page.
    if (!event->spontaneous())
        QTimer::singleShot(0, this, [this] { mHeight.borrow(*this, sizeHint().height()); });
}

void LampPanel::hideEvent(QHideEvent* event)
{
    QScrollArea::hideEvent(event);
    // Later, because docks may move, and this one is just being changed.
    if (!event->spontaneous())
        QTimer::singleShot(0, &mHeight, &BorrowedHeight::giveBack);
}

QSize LampPanel::sizeHint() const
{
    return {210, mHeader->sizeHint().height() + widget()->sizeHint().height()};
}

} // namespace lampblack
